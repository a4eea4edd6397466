// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane.h>

#include <Eigen/Core>

namespace pcl_mrf_planes {

/** \brief The ten sums of the scatter matrix M^t M, equation (4).
 *
 * Sums of double precision about the sensor, which every point is near. What cancellation
 * leaves in the rms distance of an exact plane grows with the range: 0.1 micrometres at
 * 1 m, 10 at 100 m, less than 0.1 mm at a kilometre. Sums of disjoint sets of points add
 * up to the sums of their union.
 */
struct PCL_MRF_PLANES_EXPORT ScatterMatrix {
  double n = 0.0;  ///< number of points
  double x = 0.0;  ///< sum of x, metres
  double y = 0.0;  ///< sum of y, metres
  double z = 0.0;  ///< sum of z, metres
  double xx = 0.0; ///< sum of x x, square metres
  double xy = 0.0; ///< sum of x y, square metres
  double xz = 0.0; ///< sum of x z, square metres
  double yy = 0.0; ///< sum of y y, square metres
  double yz = 0.0; ///< sum of y z, square metres
  double zz = 0.0; ///< sum of z z, square metres

  /** \brief Add one point. */
  void add(double px, double py, double pz)
  {
    n += 1.0;
    x += px;
    y += py;
    z += pz;
    xx += px * px;
    xy += px * py;
    xz += px * pz;
    yy += py * py;
    yz += py * pz;
    zz += pz * pz;
  }

  /** \brief Pool the sums of two disjoint sets of points. */
  ScatterMatrix& operator+=(const ScatterMatrix& other)
  {
    n += other.n;
    x += other.x;
    y += other.y;
    z += other.z;
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    return *this;
  }

  /** \brief The symmetric 4x4 matrix of equation (4). */
  Eigen::Matrix4d matrix() const;

  /** \brief Mean of the points, metres; n must be > 0. */
  Eigen::Vector3d centroid() const { return Eigen::Vector3d(x, y, z) / n; }

  /** \brief Covariance of the points (divided by n), square metres; n must be > 0. */
  Eigen::Matrix3d covariance() const;

  /** \brief Root mean square distance of the points to a plane, metres; n must be > 0.
   */
  double rmsDistance(const Plane& plane) const;
};

/** \brief A least-squares plane and how well it fits. */
struct PCL_MRF_PLANES_EXPORT PlaneFitResult {
  bool valid = false; ///< false: fewer than three points, or points on a line
  Plane plane;        ///< turned towards the origin
  double error =
      0.0;          ///< sqrt(lambda_min) / eta: root of the sum of squared distances, m
  double rms = 0.0; ///< error / sqrt(n): root mean square distance, metres
};

/** \brief Fit a plane to the points behind the ten sums, section IV-A, equation (3).
 *
 * ALGEBRAIC minimises |M alpha| under |alpha| = 1 and divides by eta = |(a, b, c)|;
 * GEOMETRIC minimises the perpendicular distances themselves. Constant time.
 */
PCL_MRF_PLANES_EXPORT PlaneFitResult fitPlane(const ScatterMatrix& sums, PlaneFit fit);

} // namespace pcl_mrf_planes
