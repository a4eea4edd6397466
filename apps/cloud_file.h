// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcd_header.h"

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief An organized cloud with all its fields, as it stands in a PCD file. */
struct CloudFile {
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero(); ///< of the sensor, metres
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  PcdFormat format = PcdFormat::BINARY; ///< as it was read
};

/** \brief Read an organized PCD file of any format, all fields kept.
 * \throws std::runtime_error with the file's name, what is wrong and what to do
 */
CloudFile readOrganizedCloud(const std::string& path);

/** \brief Write a PCD file, whole or not at all, the sensor pose to the last bit.
 * \throws std::runtime_error with what is wrong and what to do
 */
void writeCloud(const std::string& path, const CloudFile& file, PcdFormat format);

} // namespace pcl_mrf_planes::apps
