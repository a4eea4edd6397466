// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/region_graph.h"
#include <algorithm>
#include <cmath>
#include <queue>

namespace pcl_mrf_planes::adaptive {

double allowedVariance(const FittedPlane& plane, const NoiseLaw& noise,
                       const AdaptiveParameters& p)
{
  const double g = noise.growthOf(plane.n);
  const double f = std::min(p.flatness * plane.extent, p.max_flatness);
  return g * g * plane.noise * incidenceFactor(plane) + f * f;
}

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters)
{
  TileRegions out;
  const TileLevel& cells = pyramid[0];
  out.cell_region.assign(cells.sums.size(), -1);
  for (std::size_t l = pyramid.size(); l-- > 0;) {
    const TileLevel& level = pyramid[l];
    const int k = 1 << l;
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.columns; ++c) {
        const FittedPlane& plane = level.planes[level.at(c, r)];
        if (plane.n < 4 || out.cell_region[cells.at(c * k, r * k)] >= 0)
          continue;
        const double tolerance = parameters.tile_tolerance * parameters.tile_tolerance;
        const double mse = plane.mse * plane.n / (plane.n - 3);
        if (mse > tolerance * allowedVariance(plane, noise, parameters))
          continue;
        const int id = static_cast<int>(out.planes.size());
        out.planes.push_back(plane);
        out.sums.push_back(level.sums[level.at(c, r)]);
        for (int j = r * k; j < std::min((r + 1) * k, cells.rows); ++j)
          for (int i = c * k; i < std::min((c + 1) * k, cells.columns); ++i)
            out.cell_region[cells.at(i, j)] = id;
      }
  }
  return out;
}

TileRegions mergeTouching(const TileRegions& tiles,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  Regions regions(tiles);
  const TileLevel& cells = pyramid[0];
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      const int a = tiles.cell_region[cells.at(c, r)];
      const int right =
          c + 1 < cells.columns ? tiles.cell_region[cells.at(c + 1, r)] : -1;
      const int down = r + 1 < cells.rows ? tiles.cell_region[cells.at(c, r + 1)] : -1;
      if (a >= 0 && right >= 0 && right != a)
        regions.touch(a, right);
      if (a >= 0 && down >= 0 && down != a)
        regions.touch(a, down);
    }
  std::priority_queue<Candidate> queue;
  const double limit = parameters.merge_tolerance * parameters.merge_tolerance;
  const auto offer = [&](int a, int b) {
    if (a > b)
      std::swap(a, b);
    const double cost =
        dissimilarity(regions.plane(a), regions.plane(b),
                      regions.sums(a) + regions.sums(b), noise, parameters);
    if (cost >= 0 && cost <= limit)
      queue.push({cost, a, b, regions.version(a), regions.version(b)});
  };
  for (int a = 0; a < regions.size(); ++a)
    for (const int b : regions.neighbours(a))
      if (a < b)
        offer(a, b);
  while (!queue.empty()) {
    const Candidate next = queue.top();
    queue.pop();
    if (regions.version(next.a) != next.version_a ||
        regions.version(next.b) != next.version_b)
      continue;
    const int a = regions.merge(next.a, next.b);
    for (const int b : regions.neighbours(a))
      offer(a, b);
  }
  return collect(regions, tiles.cell_region, 0.5 * parameters.min_points);
}

} // namespace pcl_mrf_planes::adaptive
