// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"
#include "segmented_cloud.h"

#include <pcl_mrf_planes/io/frame.h>

namespace pcl_mrf_planes::apps {

/** \brief A frame that was read and segmented. */
struct FrameAndResult {
  io::Frame frame;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;
  SegmentedCloud result;
};

/** \brief Read and segment.
 * \throws std::runtime_error with the input's name, what is wrong and what to do */
FrameAndResult segmentFrame(const io::FrameSource& source, const Options& options);

} // namespace pcl_mrf_planes::apps
