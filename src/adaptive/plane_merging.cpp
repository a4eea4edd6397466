// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/region_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

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

/// A queue of numbers by cost, the least first, those of costs within three per cent of one
/// another as one: the last of them first. Costs at or below the least power of two are
/// one, too. All operations are O(1) but for steps over empty buckets.
class CostQueue {
public:
  explicit CostQueue(float most)
  : newest_(bucketOf(most) + 1, NOTHING)
  , first_(newest_.size())
  {}

  bool empty()
  {
    while (first_ < newest_.size() && newest_[first_] == NOTHING)
      ++first_;
    return first_ == newest_.size();
  }

  void push(float cost, std::uint32_t number)
  {
    const std::size_t bucket = bucketOf(cost);
    if (number >= older_.size())
      older_.resize(number + 1);
    older_[number] = newest_[bucket];
    newest_[bucket] = number;
    first_ = std::min(first_, bucket);
  }

  /// Of a queue that is not empty, as empty() has just told.
  std::uint32_t pop()
  {
    const std::uint32_t number = newest_[first_];
    newest_[first_] = older_[number];
    return number;
  }

private:
  static constexpr std::uint32_t NOTHING = UINT32_MAX;

  /// Exponent and upper bits of the mantissa: their order is that of the numbers.
  static std::size_t bucketOf(float cost)
  {
    constexpr float LEAST = 1.0F / (1U << 20U);
    constexpr std::uint32_t LEFT_OUT = 18; // of the 23 bits of the mantissa
    const auto bits = [](float number) {
      std::uint32_t word = 0;
      std::memcpy(&word, &number, sizeof(word));
      return word >> LEFT_OUT;
    };
    return bits(std::max(cost, LEAST)) - bits(LEAST);
  }

  std::vector<std::uint32_t> newest_; ///< of each bucket
  std::vector<std::uint32_t> older_;  ///< the next of the same bucket, by number
  std::size_t first_;                 ///< no bucket before it holds any
};

/// Merges pairs of regions, the most alike first.
class Agglomeration {
public:
  Agglomeration(Regions& regions, const NoiseLaw& noise,
                const AdaptiveParameters& parameters)
  : regions_(regions)
  , noise_(noise)
  , parameters_(parameters)
  , limit_(parameters.merge_tolerance * parameters.merge_tolerance)
  , queue_(static_cast<float>(limit_))
  {}

  /// Merges until no two neighbours are one plane. \return whether any were
  bool run()
  {
    pairs_.clear();
    looked_at_ = 0;
    for (int a = 0; a < regions_.size(); ++a)
      if (regions_.find(a) == a)
        regions_.forEachNeighbour(a, [&](int b) {
          if (a < b)
            offer(a, b);
        });
    consider();
    bool merged = false;
    Pair next;
    while (popCurrent(next)) {
      regions_.merge(next.a, next.b);
      merged = true;
    }
    return merged;
  }

private:
  /// Two regions, as they were when they were offered.
  struct Pair {
    int a, b;
    int tiles; ///< of both: grows with every merge
    float cost;
  };

  /// The most alike pair as things stand. Those above it that have grown since they were
  /// looked at are looked at again, as many at once as there are.
  bool popCurrent(Pair& next)
  {
    while (!queue_.empty()) {
      const std::uint32_t number = queue_.pop();
      next = pairs_[number];
      const int a = regions_.find(next.a);
      const int b = regions_.find(next.b);
      if (a == b)
        continue;
      const bool current = regions_.tiles(a) + regions_.tiles(b) == next.tiles;
      if (!current)
        offer(a, b);
      else if (looked_at_ == pairs_.size())
        return true;
      else
        queue_.push(next.cost, number);
      if (current || queue_.empty())
        consider();
    }
    return false;
  }

  void offer(int a, int b)
  {
    if (pairs_.size() - looked_at_ == AT_ONCE)
      consider();
    joint_[pairs_.size() - looked_at_] = regions_.sums(a) + regions_.sums(b);
    pairs_.push_back({a, b, regions_.tiles(a) + regions_.tiles(b), 0.0F});
  }

  /// Queues the new pairs that may be one plane.
  void consider()
  {
    fitPlanes(joint_.data(), pairs_.size() - looked_at_, planes_.data());
    for (const FittedPlane* plane = planes_.data(); looked_at_ < pairs_.size();
         ++looked_at_, ++plane) {
      Pair& pair = pairs_[looked_at_];
      const double cost = dissimilarity(regions_.plane(pair.a), regions_.plane(pair.b),
                                        *plane, noise_, parameters_);
      pair.cost = static_cast<float>(cost);
      if (cost >= 0 && cost <= limit_)
        queue_.push(pair.cost, static_cast<std::uint32_t>(looked_at_));
    }
  }

  static constexpr std::size_t AT_ONCE = 64; ///< pairs that stay in the nearest cache

  Regions& regions_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  double limit_;
  CostQueue queue_;
  std::vector<Pair> pairs_;             ///< in the order in which they were offered
  std::size_t looked_at_ = 0;           ///< so many of them, the first
  std::array<TileSums, AT_ONCE> joint_; ///< of the others
  std::array<FittedPlane, AT_ONCE> planes_;
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
