// SPDX-License-Identifier: BSD-3-Clause
#include "cape.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_mrf_planes::benchmarks::cape {

namespace {

/// Cells around a seed, each of whose normal and place agree with those of the cell
/// that it is reached from. They are taken out of \a is_free.
std::vector<int> growFrom(int seed, const std::vector<Cell>& cells,
                          const BlockGrid& grid, double least_cosine,
                          std::vector<bool>& is_free)
{
  std::vector<int> grown = {seed};
  is_free[static_cast<std::size_t>(seed)] = false;
  for (std::size_t next = 0; next < grown.size(); ++next) {
    const PlanePatch& from = cells[static_cast<std::size_t>(grown[next])].patch;
    for (const int beside : grid.neighbours(grown[next])) {
      if (beside < 0 || !is_free[static_cast<std::size_t>(beside)])
        continue;
      const Cell& cell = cells[static_cast<std::size_t>(beside)];
      if (from.normal.dot(cell.patch.normal) < least_cosine ||
          std::abs(from.distance(cell.patch.centre)) > cell.reach)
        continue;
      is_free[static_cast<std::size_t>(beside)] = false;
      grown.push_back(beside);
    }
  }
  return grown;
}

Segment segmentOf(std::vector<int> of, const std::vector<Cell>& cells)
{
  Segment segment;
  segment.cells = std::move(of);
  for (const int cell : segment.cells)
    segment.patch.sums += cells[static_cast<std::size_t>(cell)].patch.sums;
  segment.patch.fit();
  return segment;
}

} // namespace

std::vector<Segment> growSegments(const std::vector<Cell>& cells, const BlockGrid& grid,
                                  const Parameters& parameters)
{
  const double least_cosine = std::cos(parameters.angle * M_PI / 180.0);
  NormalHistogram histogram(cells, parameters.histogram_bins);
  std::vector<bool> is_free(cells.size());
  std::transform(cells.begin(), cells.end(), is_free.begin(),
                 [](const Cell& cell) { return cell.is_planar; });
  std::vector<Segment> segments;
  for (;;) {
    const std::vector<int> seeds = histogram.fullestBin();
    if (static_cast<int>(seeds.size()) < parameters.min_seeds)
      return segments;
    const int seed = *std::min_element(seeds.begin(), seeds.end(), [&](int a, int b) {
      return cells[static_cast<std::size_t>(a)].patch.mse <
             cells[static_cast<std::size_t>(b)].patch.mse;
    });
    std::vector<int> grown = growFrom(seed, cells, grid, least_cosine, is_free);
    for (const int cell : grown)
      histogram.remove(cell);
    if (static_cast<int>(grown.size()) < parameters.min_cells)
      continue;
    Segment segment = segmentOf(std::move(grown), cells);
    if (segment.patch.flatness > parameters.min_flatness)
      segments.push_back(std::move(segment));
  }
}

} // namespace pcl_mrf_planes::benchmarks::cape
