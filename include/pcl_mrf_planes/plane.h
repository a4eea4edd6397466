// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <Eigen/Core>

#include <cmath>

namespace pcl_mrf_planes {

/** \brief The plane a x + b y + c z + d = 0 with (a, b, c) of unit length.
 *
 * In the sensor frame, turned towards the sensor at the origin: d >= 0. That makes the
 * four numbers of a plane unique, which the dissimilarity (5) needs.
 */
struct PCL_MRF_PLANES_EXPORT Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< (a, b, c)
  double d = 0.0;                                    ///< metres

  /** \brief Signed distance of a point in metres. */
  double distance(const Eigen::Vector3d& point) const { return normal.dot(point) + d; }

  /** \brief Turn the normal so that the origin lies in front of the plane: d >= 0.
   *
   * A plane through the origin itself is turned by the sign of its first coefficient
   * that is not zero, so that alpha and -alpha still give one result.
   */
  void orientTowardsOrigin()
  {
    double sign = d;
    for (int axis = 0; sign == 0.0 && axis < 3; ++axis)
      sign = normal[axis];
    if (sign < 0.0) {
      normal = -normal;
      d = -d;
    }
  }

  /** \brief a, b, c or d for \a axis 0 to 3. */
  double coefficient(int axis) const { return axis < 3 ? normal[axis] : d; }
};

/** \brief Dissimilarity of two planes, equations (5) and (9); >= 0, 0 for equal planes.
 * \param[in] p, q planes turned towards the sensor
 * \param[in] beta weight of the difference of the offsets, 1/m
 */
inline double dissimilarity(const Plane& p, const Plane& q, double beta)
{
  // max: the dot product of two unit vectors may exceed 1 by rounding.
  return std::fmax(0.0, 1.0 - p.normal.dot(q.normal)) + beta * std::abs(p.d - q.d);
}

} // namespace pcl_mrf_planes
