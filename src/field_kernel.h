// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes {

/// The plane and the scale of equation (7) in single precision.
struct DataTerm {
  float a, b, c, d;
  float tau;   ///< metres
  float scale; ///< 16-bit units per metre: lambda times the units per energy
};

/// Costs of one label for a row of points: round(scale * min(|a x + b y + c z + d|,
/// tau)), 0 where valid is 0. The same bits for every instruction set: products and
/// sums are not fused.
void dataTermRow(const DataTerm& term, const float* x, const float* y, const float* z,
                 const std::uint8_t* valid, std::size_t count, std::uint16_t* cost);

/// Weights of the edges between two rows of points: round(scale * |depth - other|), at
/// most 65534, and 65535 (no edge) where either point is not valid.
void edgeWeightRow(const float* depth, const float* other_depth,
                   const std::uint8_t* valid, const std::uint8_t* other_valid,
                   float scale, std::size_t count, std::uint16_t* weight);

} // namespace pcl_mrf_planes
