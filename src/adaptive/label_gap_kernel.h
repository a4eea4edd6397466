// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes::adaptive {

/// What a change of label costs across the edges between two rows of points.
struct EdgePrices {
  float price; ///< where there is no step in depth
  float least; ///< share of it that is left at any step
};

/// Prices between points of depth \a a and \a b, 0 where either is invalid.
/// \param[in] per_step one over the step that halves the price, for each edge
void edgePriceRow(const EdgePrices& prices, const float* a, const float* b,
                  const std::uint8_t* a_valid, const std::uint8_t* b_valid,
                  const float* per_step, std::size_t count, float* out);

/// A label that may be had in a block, and how its data cost is computed.
struct GapCandidate {
  std::uint16_t label = 0;          ///< 0: "no plane"
  float a = 0, b = 0, c = 0, d = 0; ///< of its plane
  float per_sigma = 0;              ///< sigmas per metre
};

/// Eight neighbouring points of a row. Prices and labels beyond the image are there to be
/// read; the prices are 0.
struct GapRow {
  const float* x;
  const float* y;
  const float* z;
  const std::uint16_t* labels; ///< of the points, and of those around them
  const std::uint16_t* labels_above;
  const std::uint16_t* labels_below;
  const float* right; ///< prices to the right; right[-1] that of the first point's left
  const float* above;
  const float* below;
};

/// Costs of the field that do not depend on a plane, sigmas.
struct GapCosts {
  float none; ///< data cost of "no plane"
  float most; ///< largest data cost of a plane
};

/// What the second best label of each of eight points costs more than the one it has, all
/// neighbours keeping theirs; 0 where another one is better. O(candidates)
void gapsOfEight(const GapCosts& costs, const GapRow& row,
                 const GapCandidate* candidates, std::size_t count, float* gaps);

/// How fast certainty grows with a gap g: the exponent linear * g + squared * g^2.
struct GapExponent {
  float linear;
  float squared;
};

/// 1 - exp(-exponent), right to 1e-6, and 0 for invalid points. In place.
void gapsToShares(const GapExponent& exponent, const std::uint8_t* valid,
                  std::size_t count, float* gaps);

} // namespace pcl_mrf_planes::adaptive
