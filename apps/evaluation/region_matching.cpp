// SPDX-License-Identifier: BSD-3-Clause
#include "region_matching.h"

namespace pcl_mrf_planes::evaluation {

std::vector<RegionOverlap> planeOverlaps(const ContingencyTable& table, int min_points)
{
  std::vector<RegionOverlap> overlaps;
  for (const auto& cell : table.cells) {
    const auto& truth = table.truth[cell.truth];
    const auto& label = table.labels[cell.label];
    if (!truth.isPlane() || !label.isPlane() || truth.points <= min_points)
      continue;
    const std::int64_t together =
        truth.points + label.points - label.on_no_plane - cell.points;
    overlaps.push_back(
        {cell.truth, cell.label,
         static_cast<double>(cell.points) / static_cast<double>(together)});
  }
  return overlaps;
}

} // namespace pcl_mrf_planes::evaluation
