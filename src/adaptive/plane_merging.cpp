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

bool isPlane(const FittedPlane& plane, double least, const NoiseLaw& noise,
             const AdaptiveParameters& p)
{
  const double tolerance = p.accept_tolerance * p.accept_tolerance;
  return plane.n >= least && plane.mse <= tolerance * allowedVariance(plane, noise, p);
}

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters)
{
  TileRegions out;
  const TileLevel& cells = pyramid[0];
  out.cell_region.assign(cells.sums.size(), -1);
  const auto smallest = static_cast<std::size_t>(parameters.smallest_level);
  for (std::size_t l = pyramid.size(); l-- > smallest;) {
    const TileLevel& level = pyramid[l];
    const int k = 1 << l;
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.columns; ++c) {
        if (out.cell_region[cells.at(c * k, r * k)] >= 0)
          continue;
        const FittedPlane plane = level.planes.empty()
                                      ? fitTile(level, level.at(c, r), parameters)
                                      : level.planes[level.at(c, r)];
        if (plane.n < 4)
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

namespace {

/// Tiles that lie side by side.
void findNeighbours(const TileRegions& tiles, const TileLevel& cells, Regions& regions)
{
  const auto touch = [&](int a, int b) {
    if (a >= 0 && b >= 0 && a != b)
      regions.touch(a, b);
  };
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      const int a = tiles.cell_region[cells.at(c, r)];
      if (c + 1 < cells.columns)
        touch(a, tiles.cell_region[cells.at(c + 1, r)]);
      if (r + 1 < cells.rows)
        touch(a, tiles.cell_region[cells.at(c, r + 1)]);
    }
}

/// Pairs of regions, the most alike first.
class Agglomeration {
public:
  Agglomeration(Regions& regions, const NoiseLaw& noise,
                const AdaptiveParameters& parameters)
  : regions_(regions)
  , noise_(noise)
  , parameters_(parameters)
  , limit_(parameters.merge_tolerance * parameters.merge_tolerance)
  {}

  /// Merges until no two neighbours are one plane. \return whether any were
  bool run()
  {
    for (int a = 0; a < regions_.size(); ++a)
      if (regions_.find(a) == a)
        for (const int b : regions_.neighbours(a))
          if (a < b)
            offer(a, b);
    bool merged = false;
    while (!queue_.empty()) {
      const Candidate next = queue_.top();
      queue_.pop();
      const int a = regions_.find(next.a);
      const int b = regions_.find(next.b);
      if (a == b)
        continue;
      if (regions_.tiles(a) + regions_.tiles(b) != next.tiles) {
        offer(a, b); // either has grown since: how alike are they now?
        continue;
      }
      regions_.merge(a, b);
      merged = true;
    }
    return merged;
  }

private:
  void offer(int a, int b)
  {
    const double cost =
        dissimilarity(regions_.plane(a), regions_.plane(b),
                      regions_.sums(a) + regions_.sums(b), noise_, parameters_);
    if (cost >= 0 && cost <= limit_)
      queue_.push({cost, std::min(a, b), std::max(a, b),
                   regions_.tiles(a) + regions_.tiles(b)});
  }

  Regions& regions_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  double limit_;
  std::priority_queue<Candidate> queue_;
};

} // namespace

TileRegions mergeTouching(const TileRegions& tiles,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  Regions regions(tiles);
  findNeighbours(tiles, pyramid[0], regions);
  Agglomeration agglomeration(regions, noise, parameters);
  while (agglomeration.run()) // what was too different may fit what has grown
    ;
  return collect(regions, tiles.cell_region, 0.5 * parameters.min_points);
}

} // namespace pcl_mrf_planes::adaptive
