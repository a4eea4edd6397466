// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "region_analysis.h"
#include "timing.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief One plane of a segmented cloud, in the frame of the cloud. */
struct PlaneSummary {
  Eigen::Vector4f coefficients; ///< a b c d
  Eigen::Vector4f centroid;     ///< metres
  std::size_t points = 0;
  double area = 0.0; ///< square metres
  double rms = 0.0;  ///< metres
};

/** \brief What the files and the table of the app are made from. */
struct SegmentedCloud {
  std::vector<PlaneSummary> planes; ///< label k is planes[k - 1]
  pcl::PointCloud<pcl::Label> labels;
  SegmentationReport report;
  RegionAnalysis analysis;
  Timing timing;
  Timing analysis_timing;
};

/** \brief Segment \a cloud \a repeat times with the same result, and time it.
 * \throws std::runtime_error when the segmentation gives none
 */
SegmentedCloud segmentCloud(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud,
                            const Parameters& parameters, int repeat,
                            const RegionOptions& region_options = {});

} // namespace pcl_mrf_planes::apps
