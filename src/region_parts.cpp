// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/region_parts.h>

#include "label_runs.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace pcl_mrf_planes {

namespace {

constexpr std::size_t MOST_PARTS = 65000; // labels are 16-bit numbers

/// The parts that are large enough, in the order of the image.
std::vector<std::size_t> keptParts(const RunParts& parts, int min_points)
{
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < parts.size.size(); ++k)
    if (parts.size[k] >= min_points)
      kept.push_back(k);
  if (kept.size() > MOST_PARTS) {
    std::stable_sort(kept.begin(), kept.end(), [&](std::size_t a, std::size_t b) {
      return parts.size[a] > parts.size[b];
    });
    kept.resize(MOST_PARTS);
    std::sort(kept.begin(), kept.end());
  }
  return kept;
}

} // namespace

std::vector<PlaneRegion> separateParts(const OrganizedPoints& points,
                                       const std::vector<PlaneRegion>& regions,
                                       int min_points, double min_area)
{
  const LabelRuns image = regionRuns(regions, points.width, points.height);
  const RunParts parts = connectRuns(image);
  const std::vector<std::size_t> kept = keptParts(parts, min_points);

  std::vector<std::uint16_t> new_label(parts.size.size(), NO_PLANE);
  std::vector<Plane> planes;
  std::vector<int> region_of_part;
  for (const std::size_t part : kept) {
    new_label[part] = static_cast<std::uint16_t>(planes.size());
    region_of_part.push_back(parts.label[part] - 1);
    planes.push_back(regions[static_cast<std::size_t>(region_of_part.back())].plane);
  }
  std::vector<std::uint16_t> labels(points.size(), NO_PLANE);
  for (std::size_t k = 0; k < image.runs.size(); ++k)
    fillRun(image.runs[k], new_label[static_cast<std::size_t>(parts.part_of_run[k])],
            labels);
  std::vector<PlaneRegion> result =
      gatherRegions(points, planes, labels, min_points, min_area);
  for (PlaneRegion& part : result)
    part.label = region_of_part[static_cast<std::size_t>(part.label)];
  return result;
}

} // namespace pcl_mrf_planes
