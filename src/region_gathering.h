// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_runs.h"

#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/scatter_matrix.h>

namespace pcl_mrf_planes {

/// gatherRegions() of what is known already: the runs of the label planes, which carry valid
/// points only, and the ten sums of the points of each. O(runs + labelled points)
std::vector<PlaneRegion>
gatherRegions(const OrganizedPoints& points, const std::vector<Plane>& planes,
              const LabelRuns& image, const std::vector<ScatterMatrix>& scatter,
              int min_points, double min_area, unsigned int threads = 1);

/// gatherRegions() by so many threads, 0 for as many as there are cores.
std::vector<PlaneRegion> gatherRegions(const OrganizedPoints& points,
                                       const std::vector<Plane>& planes,
                                       const std::vector<std::uint16_t>& labels,
                                       int min_points, double min_area,
                                       unsigned int threads);

/// Writes the label of its region, from 1, or 0 where there is none, over every run. Points
/// of no run are left as they are.
void paintRegions(const LabelRuns& image, const std::vector<PlaneRegion>& regions,
                  std::size_t planes, std::vector<std::uint16_t>& labels,
                  unsigned int threads = 1);

} // namespace pcl_mrf_planes
