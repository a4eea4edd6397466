// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "region_options.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief How two regions lie to each other. */
struct RegionRelation {
  std::size_t first = 0; ///< index, less than second
  std::size_t second = 0;
  double angle = 0.0;    ///< between the normals, radians
  double distance = 0.0; ///< of the centroids from the planes, metres
};

/** \brief What follows from a segmentation, as far as it was asked for; in the frame of the
 * cloud. */
struct RegionAnalysis {
  std::vector<PlaneUncertainty> uncertainties; ///< one for each plane
  std::vector<RegionOutline> outlines;
  std::vector<PlaneCrease> creases;
  std::vector<RegionRelation> relations; ///< of all pairs, with the creases
  std::vector<float> confidence;
  pcl::PointCloud<pcl::PointXYZ> projected;
  std::vector<std::pair<std::string, double>> stage_ms; ///< of what was asked for
};

/** \brief Work out what the options ask for from the last run.
 * \param[out] analysis the result; memory that it has is used again */
void analyseRegions(const pcl::MRFPlaneSegmentation<pcl::PointXYZ>& segmentation,
                    const RegionOptions& options, RegionAnalysis& analysis);

} // namespace pcl_mrf_planes::apps
