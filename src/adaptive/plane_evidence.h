// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/noise_estimation.h"
#include "adaptive/tile_sums.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

/// What the equation of a plane saves in the description of its points, nats: n
/// ln(width / rms) tell where on the plane they lie, and not where in a slab as thick as it
/// is wide. Chance makes little of it. As if the noise of the points were independent.
inline double evidenceOf(const FittedPlane& plane)
{
  constexpr double THINNEST = 1e-6; // metres
  const double rms = std::max(std::sqrt(plane.mse), THINNEST);
  return plane.n * std::log(plane.width / rms);
}

/// So many points hold the information of one with independent noise.
inline double pointsPerIndependentOne(const NoiseLaw& noise)
{
  const double correlation = noise.growth.back() / noise.growth.front();
  return correlation * correlation;
}

} // namespace pcl_mrf_planes::adaptive
