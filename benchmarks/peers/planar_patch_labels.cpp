// SPDX-License-Identifier: BSD-3-Clause
#include "patch_rectangle.h"
#include "planar_patches.h"

#include <limits>

namespace pcl_mrf_planes::benchmarks::patches {

Labels labelMembers(const PointSet& set, const std::vector<Patch>& patches,
                    std::size_t size)
{
  Labels labels(size, 0);
  for (std::size_t k = 0; k < patches.size(); ++k)
    for (const int point : patches[k].members)
      labels[set.places[static_cast<std::size_t>(point)]] =
          static_cast<std::uint16_t>(k + 1);
  return labels;
}

Labels labelBoxes(const PointSet& set, const std::vector<Patch>& patches,
                  std::size_t size)
{
  Labels labels(size, 0);
  std::vector<float> nearest(set.size(), std::numeric_limits<float>::max());
  for (std::size_t k = 0; k < patches.size(); ++k) {
    const PatchRectangle rectangle(set, patches[k]);
    for (std::size_t i = 0; i < set.size(); ++i) {
      const float distance = patches[k].distance(set.points[i]);
      if (distance < patches[k].most_distance && distance < nearest[i] &&
          rectangle.covers(set.points[i])) {
        nearest[i] = distance;
        labels[set.places[i]] = static_cast<std::uint16_t>(k + 1);
      }
    }
  }
  return labels;
}

} // namespace pcl_mrf_planes::benchmarks::patches
