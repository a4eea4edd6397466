// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/region_graph.h"
#include "threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

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

/// Takes tiles of a part of the image level by level, where none of a larger one lies yet.
class TileSelection {
public:
  /// \param cell_region region of each cell of the image, none yet in this part
  TileSelection(const TileLevel& cells, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, std::vector<int>& cell_region)
  : cells_(cells)
  , noise_(noise)
  , parameters_(parameters)
  , cell_region_(cell_region)
  {}

  void addRow(const TileLevel& level, int row)
  {
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

  FittedRegions regions;

private:
  /// Columns of a row of tiles that no larger tile covers.
  void findFree(const TileLevel& level, int row)
  {
    const int k = level.side / CELL;
    free_.clear();
    sums_.clear();
    for (int column = 0; column < level.columns; ++column) {
      const std::size_t tile = level.at(column, row);
      if (cell_region_[cells_.at(column * k, row * k)] >= 0 ||
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
    regions.add(plane, level.sums[level.at(column, row)]);
    const int k = level.side / CELL;
    for (int r = row * k; r < std::min((row + 1) * k, cells_.rows); ++r)
      for (int c = column * k; c < std::min((column + 1) * k, cells_.columns); ++c)
        cell_region_[cells_.at(c, r)] = id;
  }

  const TileLevel& cells_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  std::vector<int>& cell_region_;
  // of the row at hand
  std::vector<int> free_;
  std::vector<TileSums> sums_;
  std::vector<FittedPlane> planes_;
};

/// Where the tiles of the levels lie among those that one part of the image selected.
using LevelStarts = std::vector<std::size_t>;

/// Numbers the tiles of all parts anew: the largest first, those of one level part by part.
class TileNumbering {
public:
  TileNumbering(std::vector<TileSelection>& parts,
                const std::vector<LevelStarts>& starts)
  : number_(parts.size())
  {
    for (std::size_t k = 0; k < parts.size(); ++k)
      number_[k].resize(parts[k].regions.planes.size());
    for (std::size_t level = 0; level + 1 < starts[0].size(); ++level)
      for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t i = starts[k][level]; i < starts[k][level + 1]; ++i)
          number_[k][i] = count_++;
  }

  std::size_t count() const { return static_cast<std::size_t>(count_); }
  int operator()(std::size_t part, std::size_t tile) const
  {
    return number_[part][tile];
  }

private:
  std::vector<std::vector<int>> number_;
  int count_ = 0;
};

} // namespace

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, unsigned int threads)
{
  const auto smallest = static_cast<std::size_t>(parameters.smallest_level);
  const TileLevel& cells = pyramid[0];
  const Bands bands(pyramid.back().rows);
  TileRegions out;
  out.cell_region.assign(cells.sums.size(), -1);
  std::vector<TileSelection> parts(static_cast<std::size_t>(bands.count),
                                   {cells, noise, parameters, out.cell_region});
  std::vector<LevelStarts> starts(parts.size(), {0});
  parallelParts(bands.count, threads, [&](int band) {
    const auto part = static_cast<std::size_t>(band);
    for (std::size_t l = pyramid.size(); l-- > smallest;) {
      const int rows = 1 << (pyramid.size() - 1 - l); // in one of the largest tiles
      const int end = std::min(bands.begin(band + 1) * rows, pyramid[l].rows);
      for (int row = bands.begin(band) * rows; row < end; ++row)
        parts[part].addRow(pyramid[l], row);
      starts[part].push_back(parts[part].regions.planes.size());
    }
  });

  const TileNumbering number(parts, starts);
  out.planes.resize(number.count());
  out.sums.resize(number.count());
  const int cell_rows = pyramid.back().side / CELL;
  parallelParts(bands.count, threads, [&](int band) {
    const auto part = static_cast<std::size_t>(band);
    const FittedRegions& found = parts[part].regions;
    for (std::size_t i = 0; i < found.planes.size(); ++i) {
      const auto id = static_cast<std::size_t>(number(part, i));
      out.planes[id] = found.planes[i];
      out.sums[id] = found.sums[i];
    }
    const int end = std::min(bands.begin(band + 1) * cell_rows, cells.rows);
    for (std::size_t cell = cells.at(0, bands.begin(band) * cell_rows);
         cell < cells.at(0, end); ++cell)
      if (int& region = out.cell_region[cell]; region >= 0)
        region = number(part, static_cast<std::size_t>(region));
  });
  return out;
}

namespace {

/// Rows of cells, half open.
struct CellRows {
  int begin, end;
};

/// Tiles that lie side by side in some rows of cells.
void linkInside(const std::vector<int>& cell_region, const TileLevel& cells,
                CellRows rows, Regions& regions)
{
  const auto touch = [&](int a, int b) {
    if (a >= 0 && b >= 0 && a != b)
      regions.touch(a, b);
  };
  for (int r = rows.begin; r < rows.end; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      const int a = cell_region[cells.at(c, r)];
      if (c + 1 < cells.columns)
        touch(a, cell_region[cells.at(c + 1, r)]);
      if (r + 1 < rows.end)
        touch(a, cell_region[cells.at(c, r + 1)]);
    }
}

/// Regions on either side of the border above a row of cells.
void linkAcross(const std::vector<int>& cell_region, const TileLevel& cells, int row,
                Regions& regions)
{
  for (int c = 0; c < cells.columns; ++c) {
    const int above = cell_region[cells.at(c, row - 1)];
    const int below = cell_region[cells.at(c, row)];
    if (above >= 0 && below >= 0)
      regions.touch(regions.find(above), regions.find(below));
  }
}

/// The tiles of some rows of cells, in the order of their numbers.
std::vector<int> tilesIn(const std::vector<int>& cell_region, const TileLevel& cells,
                         CellRows rows, std::size_t tiles)
{
  std::vector<std::uint8_t> is_in(tiles, 0);
  for (std::size_t cell = cells.at(0, rows.begin); cell < cells.at(0, rows.end); ++cell)
    if (cell_region[cell] >= 0)
      is_in[static_cast<std::size_t>(cell_region[cell])] = 1;
  std::vector<int> found;
  for (std::size_t tile = 0; tile < tiles; ++tile)
    if (is_in[tile] != 0)
      found.push_back(static_cast<int>(tile));
  return found;
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
  /// \param[in] tiles none but these have neighbours
  Agglomeration(Regions& regions, std::vector<int> tiles, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, unsigned int threads)
  : regions_(regions)
  , tiles_(std::move(tiles))
  , noise_(noise)
  , parameters_(parameters)
  , threads_(threads)
  , limit_(parameters.merge_tolerance * parameters.merge_tolerance)
  , queue_(static_cast<float>(limit_))
  {}

  /// Merges until no two neighbours are one plane; what was too different may fit what has
  /// grown. \param[in] mark walks before this one \return the same after it
  int run(int mark)
  {
    mark_ = mark;
    while (mergeOnce())
      ;
    return mark_;
  }

private:
  /// \return whether any were merged
  bool mergeOnce()
  {
    offerAll();
    bool merged = false;
    std::uint32_t number = 0;
    while (popCurrent(number)) {
      const Pair& next = pairs_[number];
      regions_.merge(next.a, next.b, joint_[number]);
      merged = true;
    }
    return merged;
  }

  /// Two regions, as they were when they were offered.
  struct Pair {
    int a, b;
    int tiles; ///< of both: grows with every merge
    float cost;
  };

  /// Offers all pairs of neighbours, as if one after the other.
  void offerAll()
  {
    pairs_.clear();
    for (const int a : tiles_)
      if (regions_.find(a) == a)
        regions_.forEachNeighbour(a, ++mark_, [&](int b) {
          if (a < b)
            pairs_.push_back({a, b, regions_.tiles(a) + regions_.tiles(b), 0.0F});
        });
    joint_.resize(pairs_.size());
    const auto batches = static_cast<int>((pairs_.size() + AT_ONCE - 1) / AT_ONCE);
    parallelParts(batches, threads_, [&](int batch) {
      const std::size_t first = static_cast<std::size_t>(batch) * AT_ONCE;
      price(first, std::min(first + AT_ONCE, pairs_.size()));
    });
    looked_at_ = 0;
    queueNew();
  }

  /// The most alike pair as things stand. Those above it that have grown since they were
  /// looked at are looked at again, as many at once as there are.
  bool popCurrent(std::uint32_t& number)
  {
    while (!queue_.empty()) {
      number = queue_.pop();
      const Pair next = pairs_[number];
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
    pairs_.push_back({a, b, regions_.tiles(a) + regions_.tiles(b), 0.0F});
  }

  /// Queues the new pairs that may be one plane.
  void consider()
  {
    joint_.resize(pairs_.size());
    price(looked_at_, pairs_.size());
    queueNew();
  }

  static constexpr std::size_t AT_ONCE = 64; ///< pairs that stay in the nearest cache

  /// Fits the planes of pairs, at most AT_ONCE, and tells what it costs to merge them.
  void price(std::size_t first, std::size_t last)
  {
    std::array<TileSums, AT_ONCE> sums;
    for (std::size_t k = first; k < last; ++k)
      sums[k - first] = regions_.sums(pairs_[k].a) + regions_.sums(pairs_[k].b);
    if (first < last)
      fitPlanes(sums.data(), last - first, &joint_[first]);
    for (std::size_t k = first; k < last; ++k) {
      Pair& pair = pairs_[k];
      pair.cost = static_cast<float>(dissimilarity(regions_.plane(pair.a),
                                                   regions_.plane(pair.b), joint_[k],
                                                   noise_, parameters_));
    }
  }

  void queueNew()
  {
    for (; looked_at_ < pairs_.size(); ++looked_at_)
      if (const float cost = pairs_[looked_at_].cost; cost >= 0 && cost <= limit_)
        queue_.push(cost, static_cast<std::uint32_t>(looked_at_));
  }

  Regions& regions_;
  std::vector<int> tiles_;
  int mark_ = 0; ///< of the last walk through neighbours
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  unsigned int threads_;
  double limit_;
  CostQueue queue_;
  std::vector<Pair> pairs_;        ///< in the order in which they were offered
  std::vector<FittedPlane> joint_; ///< plane of both
  std::size_t looked_at_ = 0;      ///< so many pairs, the first
};

} // namespace

TileRegions mergeTouching(TileRegions tiles, const std::vector<TileLevel>& pyramid,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          unsigned int threads)
{
  const TileLevel& cells = pyramid[0];
  const std::size_t count = tiles.planes.size();
  std::vector<int> cell_region = std::move(tiles.cell_region);
  Regions regions(std::move(tiles));
  // Between the halves of the image nothing merges before each of them is done.
  const Bands halves(pyramid.back().rows, 2);
  const auto rows = [&](int half) {
    const int side = pyramid.back().side / CELL;
    return CellRows{halves.begin(half) * side,
                    std::min(halves.begin(half + 1) * side, cells.rows)};
  };
  for (int half = 0; half < halves.count; ++half)
    linkInside(cell_region, cells, rows(half), regions);
  std::vector<int> marks(static_cast<std::size_t>(halves.count), 0);
  parallelParts(halves.count, threads, [&](int half) {
    Agglomeration agglomeration(regions, tilesIn(cell_region, cells, rows(half), count),
                                noise, parameters, 1);
    marks[static_cast<std::size_t>(half)] = agglomeration.run(0);
  });
  if (halves.count > 1) {
    for (int half = 1; half < halves.count; ++half)
      linkAcross(cell_region, cells, rows(half).begin, regions);
    Agglomeration agglomeration(regions,
                                tilesIn(cell_region, cells, {0, cells.rows}, count),
                                noise, parameters, threads);
    agglomeration.run(*std::max_element(marks.begin(), marks.end()));
  }
  return collect(regions, std::move(cell_region), 0.5 * parameters.min_points);
}

} // namespace pcl_mrf_planes::adaptive
