// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"
#include "label_runs.h"

#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/scatter_matrix.h>

namespace pcl_mrf_planes {

/// What the regions of one cloud leave to those of the next one.
struct RegionMemory {
  std::vector<Plane> planes;             ///< of the labels
  std::vector<std::vector<int>> indices; ///< that no region has at the moment
  std::size_t most_regions = 0;          ///< of any cloud
};

/// gatherRegions() of what is known already: the runs of the label planes, which carry valid
/// points only, and the ten sums of the points of each. O(runs + labelled points)
/// \param[in,out] memory with the label planes
/// \param[in,out] regions are replaced; their memory is used again
void gatherRegions(const OrganizedPoints& points, const LabelRuns& image,
                   const FrameVector<ScatterMatrix>& scatter, int min_points,
                   double min_area, unsigned int threads, RegionMemory& memory,
                   std::vector<PlaneRegion>& regions);

/// The same of label planes and of labels, which are lost.
void gatherRegions(const OrganizedPoints& points, int min_points, double min_area,
                   unsigned int threads, std::vector<std::uint16_t>& labels,
                   RegionMemory& memory, std::vector<PlaneRegion>& regions);

/// Writes the label of its region, from 1, or 0 where there is none, over every run. Points
/// of no run are left as they are.
void paintRegions(const LabelRuns& image, const std::vector<PlaneRegion>& regions,
                  std::size_t planes, std::vector<std::uint16_t>& labels,
                  unsigned int threads = 1);

/// regionLabels() in memory that is there already.
void regionLabels(const OrganizedPoints& points,
                  const std::vector<PlaneRegion>& regions,
                  std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes
