// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/flatness.h"
#include "adaptive/plane_merging.h"

namespace pcl_mrf_planes::adaptive {

/// Where the costs of a region's label differ from those of another.
struct LabelScale {
  float a, b, c, d;
  double growth; ///< variance of the region over that of its points
  double bend;   ///< squared deviation from flatness, m^2
};

inline LabelScale labelScale(const FittedPlane& plane, const NoiseLaw& noise,
                             const AdaptiveParameters& parameters)
{
  const double growth = noise.growthOf(plane.n);
  const double bend = flatnessOf(plane, parameters);
  return {
      static_cast<float>(plane.normal.x()),     static_cast<float>(plane.normal.y()),
      static_cast<float>(plane.normal.z()),     static_cast<float>(plane.d),
      growth * growth * incidenceFactor(plane), bend * bend};
}

/// Sum of the squared distances of the points behind the ten sums, equation (3).
inline double squaredDistances(const TileSums& s, const LabelScale& plane)
{
  const double a = plane.a, b = plane.b, c = plane.c, d = plane.d;
  return a * (a * s.xx + 2 * (b * s.xy + c * s.xz + d * s.x)) +
         b * (b * s.yy + 2 * (c * s.yz + d * s.y)) + c * (c * s.zz + 2 * d * s.z) +
         d * d * s.n;
}

} // namespace pcl_mrf_planes::adaptive
