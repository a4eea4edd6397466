// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_runs.h"

#include <pcl_mrf_planes/organized_points.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes {

/// Points of a region and what their plane follows from.
struct RegionInterior {
  FrameVector<LabelRun> runs; ///< ascending
  double n = 0;               ///< points
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/** \brief The points of each region that do not lie on its border: all of their eight
 * neighbours, as far as there are any, belong to it, but for small gaps of the measurement.
 *
 * Where surfaces meet, points within the noise of both planes get the label of either;
 * those along the border are where a region has points of another surface.
 * O(runs + points of borders)
 */
std::vector<RegionInterior> regionInteriors(const OrganizedPoints& points,
                                            const std::vector<PlaneRegion>& regions);

} // namespace pcl_mrf_planes
