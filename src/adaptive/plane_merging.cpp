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

namespace {

/// Takes tiles level by level, where none of a larger one lies yet.
class TileSelection {
public:
  TileSelection(const TileLevel& cells, const NoiseLaw& noise,
                const AdaptiveParameters& parameters)
  : cells_(cells)
  , noise_(noise)
  , parameters_(parameters)
  {
    regions.cell_region.assign(cells.sums.size(), -1);
  }

  void addLevel(const TileLevel& level)
  {
    for (int row = 0; row < level.rows; ++row) {
      findFree(level, row);
      if (level.planes.empty()) {
        planes_.resize(free_.size());
        fitPlanes(sums_.data(), sums_.size(), planes_.data());
      }
      for (std::size_t k = 0; k < free_.size(); ++k) {
        const FittedPlane& plane =
            level.planes.empty() ? planes_[k] : level.planes[level.at(free_[k], row)];
        if (isFlat(plane))
          add(level, free_[k], row, plane);
      }
    }
  }

  TileRegions regions;

private:
  /// Columns of a row of tiles that no larger tile covers.
  void findFree(const TileLevel& level, int row)
  {
    const int k = level.side / CELL;
    free_.clear();
    sums_.clear();
    for (int column = 0; column < level.columns; ++column) {
      const std::size_t tile = level.at(column, row);
      if (regions.cell_region[cells_.at(column * k, row * k)] >= 0 ||
          !isFilled(level, tile, parameters_))
        continue;
      free_.push_back(column);
      if (level.planes.empty())
        sums_.push_back(level.sums[tile]);
    }
  }

  bool isFlat(const FittedPlane& plane) const
  {
    if (plane.n < 4)
      return false;
    const double tolerance = parameters_.tile_tolerance * parameters_.tile_tolerance;
    const double mse = plane.mse * plane.n / (plane.n - 3);
    return mse <= tolerance * allowedVariance(plane, noise_, parameters_);
  }

  void add(const TileLevel& level, int column, int row, const FittedPlane& plane)
  {
    const int id = static_cast<int>(regions.planes.size());
    regions.planes.push_back(plane);
    regions.sums.push_back(level.sums[level.at(column, row)]);
    const int k = level.side / CELL;
    for (int r = row * k; r < std::min((row + 1) * k, cells_.rows); ++r)
      for (int c = column * k; c < std::min((column + 1) * k, cells_.columns); ++c)
        regions.cell_region[cells_.at(c, r)] = id;
  }

  const TileLevel& cells_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  // of the row at hand
  std::vector<int> free_;
  std::vector<TileSums> sums_;
  std::vector<FittedPlane> planes_;
};

} // namespace

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters)
{
  TileSelection selection(pyramid[0], noise, parameters);
  const auto smallest = static_cast<std::size_t>(parameters.smallest_level);
  for (std::size_t l = pyramid.size(); l-- > smallest;)
    selection.addLevel(pyramid[l]);
  return std::move(selection.regions);
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
        regions_.forEachNeighbour(a, [&](int b) {
          if (a < b)
            offer(a, b);
        });
    consider();
    bool merged = false;
    Candidate next;
    while (popCurrent(next)) {
      regions_.merge(next.a, next.b);
      merged = true;
    }
    return merged;
  }

private:
  /// The most alike pair as things stand. Those above it that have grown since they were
  /// looked at are looked at again, as many at once as there are.
  bool popCurrent(Candidate& next)
  {
    while (!queue_.empty()) {
      next = queue_.top();
      queue_.pop();
      const int a = regions_.find(next.a);
      const int b = regions_.find(next.b);
      if (a == b)
        continue;
      const bool current = regions_.tiles(a) + regions_.tiles(b) == next.tiles;
      if (!current)
        offer(a, b);
      else if (pairs_.empty())
        return true;
      else
        queue_.push(next);
      if (current || queue_.empty())
        consider();
    }
    return false;
  }

  void offer(int a, int b)
  {
    pairs_.push_back({0.0, std::min(a, b), std::max(a, b),
                      regions_.tiles(a) + regions_.tiles(b)});
    joint_.push_back(regions_.sums(a) + regions_.sums(b));
  }

  /// Queues the pairs on offer that may be one plane.
  void consider()
  {
    planes_.resize(pairs_.size());
    fitPlanes(joint_.data(), joint_.size(), planes_.data());
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      Candidate& pair = pairs_[k];
      pair.cost = dissimilarity(regions_.plane(pair.a), regions_.plane(pair.b),
                                planes_[k], noise_, parameters_);
      if (pair.cost >= 0 && pair.cost <= limit_)
        queue_.push(pair);
    }
    pairs_.clear();
    joint_.clear();
  }

  Regions& regions_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  double limit_;
  std::priority_queue<Candidate> queue_;
  // on offer
  std::vector<Candidate> pairs_;
  std::vector<TileSums> joint_;
  std::vector<FittedPlane> planes_;
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
