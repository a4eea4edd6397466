// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/scatter_matrix.h>

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes::adaptive {

/// The ten sums of equation (4) and the noise of the points behind them.
struct TileSums : ScatterMatrix {
  double noise = 0; ///< sum of the small-scale noise variances of the points, m^2

  TileSums& operator+=(const TileSums& other)
  {
    ScatterMatrix::operator+=(other);
    noise += other.noise;
    return *this;
  }
};

inline TileSums operator+(TileSums a, const TileSums& b)
{
  a += b;
  return a;
}

/// The plane of a set of points with what is known of the set.
struct FittedPlane : Plane {
  double mse = 0;    ///< mean square distance of the points, m^2
  double extent = 0; ///< root of the largest eigenvalue: spread along the plane, m
  double width = 0;  ///< root of the middle eigenvalue, m
  double n = 0;      ///< points
  double noise = 0;  ///< mean small-scale noise variance of the points, m^2
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();

  /// |cos| of the angle between the ray to the centroid and the normal.
  double incidence() const
  {
    const double range = centroid.norm();
    return range > 0 ? std::min(1.0, d / range) : 1.0;
  }

  using Plane::distance;
  double distance(double x, double y, double z) const
  {
    return normal.x() * x + normal.y() * y + normal.z() * z + d;
  }
};

/// Exact least-squares planes, equation (3), by Newton's method on the characteristic
/// polynomial, as many at once as the machine has lanes; fewer than three points have none.
/// The same bits for every instruction set and in any company. O(count)
void fitPlanes(const TileSums* sums, std::size_t count, FittedPlane* planes);

inline FittedPlane fitSums(const TileSums& sums)
{
  FittedPlane plane;
  fitPlanes(&sums, 1, &plane);
  return plane;
}

} // namespace pcl_mrf_planes::adaptive
