// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/block_place.h"

namespace pcl_mrf_planes::adaptive {

/// One over the step in depth at which half the price of a change is left, at such a range.
inline float perStep(const NoiseLaw& noise, const AdaptiveParameters& parameters,
                     double range)
{
  constexpr double SLOPE = 0.01; // of the range: no step
  return static_cast<float>(
      1.0 / (parameters.step_sigmas * noise.small(range) + SLOPE * range));
}

/// Share of the price of a change that is left across a step of so many of those.
template <typename Number>
inline Number priceShare(Number step, float least)
{
  const Number falling = 1.0f / (1.0f + step * step);
  return falling > least ? falling : least;
}

/** \brief Potts weights of the edges of a field: the price of a label change, which falls with
 * the step in depth down to a share of itself, so that labels change where depth does. */
class EdgeWeights {
public:
  /** \param[in] depth of each point, as the cloud measures it */
  EdgeWeights(const OrganizedPoints& points, const float* depth, const NoiseLaw& noise,
              const AdaptiveParameters& parameters, CostUnits units);

  /** \brief Weights of all edges of a block and of those to the blocks above and to the
   * left. \param[in] range distance of its points from the sensor, metres */
  void fill(const BlockPlace& place, double range, BlockWeights& out);

private:
  /// Eight neighbouring points.
  struct PointRow {
    const float* depth;
    const std::uint8_t* valid;
  };

  BlockRow edges(std::size_t i, std::size_t j, int count) const;
  BlockRow edgesToTheLeft(const BlockPlace& place) const;
  BlockRow::Numbers weights(const PointRow& from, const PointRow& to) const;

  const OrganizedPoints& points_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  float price_; ///< of a change where there is no step
  const float* depth_;
  float per_step_ = 0.0f; ///< of the block at hand
};

} // namespace pcl_mrf_planes::adaptive
