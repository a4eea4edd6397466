// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "region_analysis.h"

#include <pcl_mrf_planes/io/cloud_file.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief The same cloud with other coordinates. */
io::CloudFile withCoordinates(const io::CloudFile& file,
                              const pcl::PointCloud<pcl::PointXYZ>& coordinates);

/** \brief The same cloud without the points that carry a label: their coordinates are NaN,
 * rows and columns stay. */
io::CloudFile withoutPlanes(const io::CloudFile& file,
                            const pcl::PointCloud<pcl::Label>& labels);

/** \brief Write a 16-bit gray PNG of numbers from 0 to 1, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeConfidenceImage(const std::string& path, const std::vector<float>& confidence,
                          int width, int height);

/** \brief Write outlines as a PLY mesh of triangles in the colours of the labels, whole or
 * not at all. \throws std::runtime_error with what is wrong and what to do */
void writePolygonMesh(const std::string& path,
                      const std::vector<RegionOutline>& outlines);

/** \brief Write what the options name, but OUT.pcd and the report. */
void writeRegionFiles(const RegionOptions& options, const io::CloudFile& file,
                      const pcl::PointCloud<pcl::Label>& labels,
                      const RegionAnalysis& analysis);

/** \brief OUT.pcd with what the options add to it. */
io::CloudFile withRegions(const RegionOptions& options, const io::CloudFile& file,
                          const RegionAnalysis& analysis);

} // namespace pcl_mrf_planes::apps
