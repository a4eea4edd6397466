// SPDX-License-Identifier: BSD-3-Clause
#include "cape.h"

#include <cmath>

namespace pcl_mrf_planes::benchmarks::cape {

namespace {

/// Which segments touch: a matrix, row by row, of which the upper half is filled.
std::vector<bool> touching(const std::vector<Segment>& segments, const BlockGrid& grid)
{
  std::vector<int> owner(grid.size(), -1);
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (const int cell : segments[k].cells)
      owner[static_cast<std::size_t>(cell)] = static_cast<int>(k);
  std::vector<bool> touch(segments.size() * segments.size(), false);
  for (std::size_t cell = 0; cell < owner.size(); ++cell)
    for (const int beside : grid.neighbours(static_cast<int>(cell))) {
      const int a = owner[cell],
                b = beside >= 0 ? owner[static_cast<std::size_t>(beside)] : -1;
      if (a >= 0 && b > a)
        touch[static_cast<std::size_t>(a) * segments.size() +
              static_cast<std::size_t>(b)] = true;
    }
  return touch;
}

/// Whether the normals agree and the middle of each lies near the plane of the other.
bool areOnePlane(const PlanePatch& a, const PlanePatch& b, const Parameters& parameters)
{
  return a.normal.dot(b.normal) > std::cos(parameters.angle * M_PI / 180.0) &&
         std::abs(a.distance(b.centre)) < parameters.merge_distance &&
         std::abs(b.distance(a.centre)) < parameters.merge_distance;
}

} // namespace

std::vector<Segment> mergeSegments(const std::vector<Segment>& segments,
                                   const BlockGrid& grid, const Parameters& parameters)
{
  const std::vector<bool> touch = touching(segments, grid);
  std::vector<Segment> merged;
  std::vector<bool> is_taken(segments.size(), false);
  for (std::size_t a = 0; a < segments.size(); ++a) {
    if (is_taken[a])
      continue;
    Segment segment = segments[a];
    // Others join the segment itself, not those that have joined it.
    for (std::size_t b = a + 1; b < segments.size(); ++b)
      if (touch[a * segments.size() + b] && !is_taken[b] &&
          areOnePlane(segment.patch, segments[b].patch, parameters)) {
        is_taken[b] = true;
        segment.patch.sums += segments[b].patch.sums;
        segment.cells.insert(segment.cells.end(), segments[b].cells.begin(),
                             segments[b].cells.end());
      }
    if (segment.cells.size() > segments[a].cells.size())
      segment.patch.fit();
    merged.push_back(std::move(segment));
  }
  return merged;
}

} // namespace pcl_mrf_planes::benchmarks::cape
