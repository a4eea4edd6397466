// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/tile_sums.h"

#include <pcl_mrf_planes/adaptive_parameters.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

/** \brief Share of max_flatness that a plane with such noise may bend by. A sensor that
 * measures well has little of the distortion of one that does not, and where there is no
 * noise a bend is there to be seen. */
inline double flatnessShare(const FittedPlane& plane, const AdaptiveParameters& p)
{
  const double sigma = std::sqrt(plane.noise);
  return sigma >= p.flatness_noise
             ? 1.0
             : std::max(p.quiet_flatness, sigma / p.flatness_noise);
}

/** \brief How far a plane of that fit may bend, metres: the more, the larger it is, and the
 * more noise its points have. */
inline double flatnessOf(const FittedPlane& plane, const AdaptiveParameters& p)
{
  return std::min(p.flatness * plane.extent, flatnessShare(plane, p) * p.max_flatness);
}

} // namespace pcl_mrf_planes::adaptive
