// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief The foremost shown point near a place of the window; -1: there is none. O(points)
 * \param[in] projection from the cloud to normalized device coordinates (-1 to 1)
 * \param[in] place x and y in those coordinates
 * \param[in] reach how far a point may be off in x and in y */
long pickPoint(const pcl::PointCloud<pcl::PointXYZ>& cloud,
               const std::vector<bool>& shown, const Eigen::Matrix4d& projection,
               const Eigen::Vector2d& place, const Eigen::Vector2d& reach);

} // namespace pcl_mrf_planes::viewer
