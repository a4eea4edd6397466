// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_cloud.h"

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Write FOLDER/plane_001.png and so on, a picture for each plane: 255 where it
 * is, 0 elsewhere. Those of a plane that is no more are removed.
 * \throws std::runtime_error with what is wrong and what to do */
void writeMasks(const std::string& folder, const SegmentedCloud& result);

/** \brief Write the valid points as binary PLY with the colours of their labels, as
 * pictures have them, and the labels.
 * \throws std::runtime_error with what is wrong and what to do */
void writeColouredPly(const std::string& path,
                      const pcl::PointCloud<pcl::PointXYZ>& cloud,
                      const pcl::PointCloud<pcl::Label>& labels);

} // namespace pcl_mrf_planes::apps
