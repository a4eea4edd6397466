// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <Eigen/Core>

namespace pcl_mrf_planes::benchmarks {

/** \brief A set of points by its sums, and the plane that fits them best: what methods
 * that merge square blocks of the image work on. */
struct PlanePatch {
  ScatterMatrix sums;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< mean of the points, metres
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit length, to the sensor
  double mse = 0.0;      ///< mean squared distance of the points, square metres
  double flatness = 0.0; ///< second variance over the least one

  /** \brief Fit the plane anew, from the sums of three points at least. */
  void fit();

  double distance(const Eigen::Vector3d& point) const
  {
    return normal.dot(point - centre);
  }
  double distance(const pcl::PointXYZ& point) const
  {
    return distance(Eigen::Vector3d(point.x, point.y, point.z));
  }
};

/** \brief Mean squared distance of points from their plane, square metres, by the sums
 * alone; sums.n must be > 0. */
double meanSquaredDistance(const ScatterMatrix& sums);

} // namespace pcl_mrf_planes::benchmarks
