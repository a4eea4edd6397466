// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/tile_sums.h"

#include <Eigen/Geometry>

#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Covariance of a set of points; symmetric.
struct Covariance {
  double xx, xy, xz, yy, yz, zz;

  explicit Covariance(const TileSums& s)
  {
    const double per = 1.0 / s.n;
    const double x = s.x * per, y = s.y * per, z = s.z * per;
    xx = s.xx * per - x * x;
    xy = s.xy * per - x * y;
    xz = s.xz * per - x * z;
    yy = s.yy * per - y * y;
    yz = s.yz * per - y * z;
    zz = s.zz * per - z * z;
  }

  double trace() const { return xx + yy + zz; }
  double minors() const { return xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz; }
  double determinant() const
  {
    return xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  }
  /// Mean square along a direction of unit length.
  double along(const Eigen::Vector3d& n) const
  {
    return n.x() * (xx * n.x() + 2 * (xy * n.y() + xz * n.z())) +
           n.y() * (yy * n.y() + 2 * yz * n.z()) + zz * n.z() * n.z();
  }
};

/// Least root of the characteristic polynomial by Newton's method from 0, which rises to
/// it: in two or three steps where the points are flat.
double leastEigenvalue(double trace, double minors, double determinant)
{
  constexpr int STEPS = 6;
  constexpr double CLOSE = 1e-7;
  double root = 0;
  for (int k = 0; k < STEPS; ++k) {
    const double slope = (3 * root - 2 * trace) * root + minors;
    const double value = ((root - trace) * root + minors) * root - determinant;
    if (!(slope > 0))
      break;
    const double step = -value / slope;
    root += step;
    if (!(step > CLOSE * root))
      break;
  }
  return std::max(root, 0.0);
}

/// Null vector of the covariance less the eigenvalue: the longest cross product of rows.
Eigen::Vector3d eigenvector(const Covariance& c, double root)
{
  const Eigen::Vector3d r0(c.xx - root, c.xy, c.xz);
  const Eigen::Vector3d r1(c.xy, c.yy - root, c.yz);
  const Eigen::Vector3d r2(c.xz, c.yz, c.zz - root);
  const Eigen::Vector3d crosses[3] = {r0.cross(r1), r0.cross(r2), r1.cross(r2)};
  const double lengths[3] = {crosses[0].squaredNorm(), crosses[1].squaredNorm(),
                             crosses[2].squaredNorm()};
  int best = lengths[1] > lengths[0] ? 1 : 0;
  best = lengths[2] > lengths[best] ? 2 : best;
  if (!(lengths[best] > 0)) // points on a line, or in one spot: any normal will do
    return Eigen::Vector3d::UnitZ();
  return crosses[best] / std::sqrt(lengths[best]);
}

} // namespace

FittedPlane fitSums(const TileSums& sums)
{
  FittedPlane plane;
  plane.n = sums.n;
  if (sums.n < 3)
    return plane;
  plane.noise = sums.noise / sums.n;
  plane.centroid = sums.centroid();
  const Covariance covariance(sums);
  const double trace = covariance.trace();
  const double minors = covariance.minors();
  const double least = leastEigenvalue(trace, minors, covariance.determinant());
  plane.normal = eigenvector(covariance, least);
  plane.d = -plane.normal.dot(plane.centroid);
  plane.orientTowardsOrigin();
  // The Rayleigh quotient is second order in the error of the vector.
  plane.mse = std::max(0.0, covariance.along(plane.normal));
  const double sum = std::max(trace - least, 0.0); // of the other two eigenvalues
  const double product = std::max(minors - least * sum, 0.0);
  const double largest =
      0.5 * sum + std::sqrt(std::max(0.25 * sum * sum - product, 0.0));
  plane.extent = std::sqrt(largest);
  plane.width = largest > 0 ? std::sqrt(product / largest) : 0.0;
  return plane;
}

} // namespace pcl_mrf_planes::adaptive
