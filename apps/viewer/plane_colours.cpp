// SPDX-License-Identifier: BSD-3-Clause
#include "plane_colours.h"

#include <algorithm>
#include <set>
#include <tuple>

namespace pcl_mrf_planes::viewer {

namespace {

struct Overlap {
  std::size_t points = 0;
  std::size_t now = 0;
  std::size_t before = 0;
};

/// Points that planes of two results share, most first.
std::vector<Overlap> overlaps(const std::vector<std::uint16_t>& now, std::size_t planes,
                              const std::vector<std::uint16_t>& before,
                              std::size_t planes_before)
{
  std::vector<std::size_t> counts(planes * planes_before, 0);
  for (std::size_t i = 0; i < now.size(); ++i)
    if (now[i] != 0 && before[i] != 0)
      ++counts[(now[i] - 1u) * planes_before + (before[i] - 1u)];
  std::vector<Overlap> all;
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > 0)
      all.push_back({counts[k], k / planes_before, k % planes_before});
  std::sort(all.begin(), all.end(), [](const Overlap& a, const Overlap& b) {
    return std::make_tuple(b.points, a.now, a.before) <
           std::make_tuple(a.points, b.now, b.before);
  });
  return all;
}

} // namespace

std::vector<std::uint32_t> PlaneColours::follow(const SegmentedView& view)
{
  std::vector<std::uint32_t> colours(view.planes.size(), 0);
  std::set<std::uint32_t> taken;
  if (labels_.size() == view.labels.size())
    for (const Overlap& o :
         overlaps(view.labels, colours.size(), labels_, colours_.size()))
      if (colours[o.now] == 0 && taken.insert(colours_[o.before]).second)
        colours[o.now] = colours_[o.before];
  std::uint32_t next = 1;
  for (std::uint32_t& colour : colours)
    if (colour == 0) {
      while (!taken.insert(next).second)
        ++next;
      colour = next;
    }
  labels_ = view.labels;
  colours_ = colours;
  return colours;
}

} // namespace pcl_mrf_planes::viewer
