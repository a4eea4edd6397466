// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/cell_runs.h"
#include "adaptive/cost_queue.h"
#include "adaptive/flatness.h"
#include "adaptive/region_graph.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

namespace pcl_mrf_planes::adaptive {

double allowedVariance(const FittedPlane& plane, const NoiseLaw& noise,
                       const AdaptiveParameters& p)
{
  const double g = noise.growthOf(plane.n);
  const double f = flatnessOf(plane, p);
  return g * g * plane.noise * incidenceFactor(plane) + f * f;
}

bool isPlane(const FittedPlane& plane, double least, const NoiseLaw& noise,
             const AdaptiveParameters& p)
{
  const double tolerance = p.accept_tolerance * p.accept_tolerance;
  return plane.n >= least && plane.mse <= tolerance * allowedVariance(plane, noise, p);
}

namespace {

void linkTiles(int a, int b, FrameVector<Touch>& touches)
{
  if (a >= 0 && b >= 0 && a != b)
    touches.push_back({a, b});
}

/// Tiles that lie side by side in some rows of cells, in the order of the cells: each one
/// touches what lies to its right, then what lies below.
FrameVector<Touch> touchesInside(const FrameVector<int>& cell_region,
                                 const TileLevel& cells, TileRows rows)
{
  const CellRuns runs(cell_region, cells, rows);
  FrameVector<Touch> touches;
  touches.reserve(2 * runs.size());
  for (int r = rows.begin; r < rows.end; ++r) {
    const bool last = r + 1 == rows.end;
    const CellRun* below = last ? nullptr : runs.begin(r + 1);
    for (const CellRun* run = runs.begin(r); run != runs.end(r); ++run) {
      const int right = run + 1 != runs.end(r) ? run[1].region : -1;
      if (last) {
        linkTiles(run->region, right, touches);
        continue;
      }
      for (; below->end < run->end; ++below)
        linkTiles(run->region, below->region, touches);
      // It lies below the last cell only.
      const bool alone = std::max(below->begin, run->begin) == run->end - 1;
      if (!alone)
        linkTiles(run->region, below->region, touches);
      linkTiles(run->region, right, touches);
      if (alone)
        linkTiles(run->region, below->region, touches);
      if (below->end == run->end)
        ++below;
    }
  }
  return touches;
}

/// Regions on either side of the border above a row of cells.
void linkAcross(const FrameVector<int>& cell_region, const TileLevel& cells, int row,
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
FrameVector<int> tilesIn(const FrameVector<int>& cell_region, const TileLevel& cells,
                         TileRows rows, std::size_t tiles)
{
  FrameVector<std::uint8_t> is_in(tiles, 0);
  for (std::size_t cell = cells.at(0, rows.begin); cell < cells.at(0, rows.end); ++cell)
    if (cell_region[cell] >= 0)
      is_in[static_cast<std::size_t>(cell_region[cell])] = 1;
  FrameVector<int> found;
  found.reserve(tiles);
  for (std::size_t tile = 0; tile < tiles; ++tile)
    if (is_in[tile] != 0)
      found.push_back(static_cast<int>(tile));
  return found;
}

/// Merges pairs of regions, the most alike first.
class Agglomeration {
public:
  /// \param[in] tiles none but these have neighbours
  Agglomeration(Regions& regions, FrameVector<int> tiles, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, unsigned int threads)
  : regions_(regions)
  , tiles_(std::move(tiles))
  , noise_(noise)
  , parameters_(parameters)
  , threads_(threads)
  , limit_(parameters.merge_tolerance * parameters.merge_tolerance)
  , queue_(static_cast<float>(limit_))
  , offered_(static_cast<std::size_t>(regions.size()), 0)
  {
    pairs_.reserve(PAIRS * tiles_.size());
    joint_.reserve(PAIRS * tiles_.size());
  }

  /// Offers all pairs of neighbours, to be priced by priceBatch().
  /// \param[in] mark walks before this one
  void begin(int mark)
  {
    mark_ = mark;
    findPairs();
  }

  int batches() const
  {
    return static_cast<int>((pairs_.size() + AT_ONCE - 1) / AT_ONCE);
  }

  /// Prices some of the pairs on offer; any number of them at once.
  void priceBatch(int batch)
  {
    const std::size_t first = static_cast<std::size_t>(batch) * AT_ONCE;
    price(first, std::min(first + AT_ONCE, pairs_.size()));
  }

  /// Merges until no two neighbours are one plane; what was too different may fit what has
  /// grown. All pairs that begin() has offered have their price.
  /// \return the mark after it
  int run()
  {
    while (mergePriced()) {
      findPairs();
      parallelParts(batches(), threads_, [&](int batch) { priceBatch(batch); });
    }
    return mark_;
  }

private:
  static constexpr std::size_t PAIRS = 4; ///< for each tile at first, about

  /// \return whether any were merged
  bool mergePriced()
  {
    looked_at_ = 0;
    queueNew();
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

  /// Offers all pairs of neighbours, as if one after the other, but for those that neither
  /// has grown since they were found too different.
  void findPairs()
  {
    pairs_.clear();
    for (const int a : tiles_)
      if (regions_.find(a) == a)
        regions_.forEachNeighbour(a, ++mark_, [&](int b) {
          if (a < b && (grew(a) || grew(b)))
            pairs_.push_back({a, b, regions_.tiles(a) + regions_.tiles(b), 0.0F});
        });
    for (const int a : tiles_)
      offered_[static_cast<std::size_t>(a)] = regions_.tiles(a);
    joint_.resize(pairs_.size());
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

  bool grew(int region) const
  {
    return offered_[static_cast<std::size_t>(region)] != regions_.tiles(region);
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
  FrameVector<int> tiles_;
  int mark_ = 0; ///< of the last walk through neighbours
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  unsigned int threads_;
  double limit_;
  CostQueue queue_;
  FrameVector<int> offered_;       ///< tiles of each region when it was last offered
  FrameVector<Pair> pairs_;        ///< in the order in which they were offered
  FrameVector<FittedPlane> joint_; ///< plane of both
  std::size_t looked_at_ = 0;      ///< so many pairs, the first
};

} // namespace

TileRegions mergeTouching(TileRegions tiles, const std::vector<TileLevel>& pyramid,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          unsigned int threads)
{
  const TileLevel& cells = pyramid[0];
  const std::size_t count = tiles.planes.size();
  FrameVector<int> cell_region = std::move(tiles.cell_region);
  Regions regions(std::move(tiles));
  // Between the halves of the image nothing merges before each of them is done.
  const Bands halves(pyramid.back().rows, 2);
  const auto rows = [&](int half) {
    return rowsInside(cells, pyramid.back(),
                      {halves.begin(half), halves.begin(half + 1)});
  };
  FrameVector<FrameVector<Touch>> touches(static_cast<std::size_t>(halves.count));
  parallelParts(halves.count, threads, [&](int half) {
    touches[static_cast<std::size_t>(half)] =
        touchesInside(cell_region, cells, rows(half));
  });
  regions.touchAll(touches, threads);
  std::array<std::optional<Agglomeration>, 2> inside;
  const auto of = [&](int half) -> Agglomeration& {
    return *inside[static_cast<std::size_t>(half)];
  };
  parallelParts(halves.count, threads, [&](int half) {
    inside[static_cast<std::size_t>(half)].emplace(
        regions, tilesIn(cell_region, cells, rows(half), count), noise, parameters, 1U);
    of(half).begin(0);
  });
  // One half has more to merge than the other: what both can do of it comes first.
  const int upper = of(0).batches();
  parallelParts(upper + (halves.count > 1 ? of(1).batches() : 0), threads,
                [&](int batch) {
                  if (batch < upper)
                    of(0).priceBatch(batch);
                  else
                    of(1).priceBatch(batch - upper);
                });
  std::array<int, 2> marks = {};
  parallelParts(halves.count, threads, [&](int half) {
    marks[static_cast<std::size_t>(half)] = of(half).run();
    inside[static_cast<std::size_t>(half)].reset();
  });
  if (halves.count > 1) {
    linkAcross(cell_region, cells, rows(1).begin, regions);
    FrameVector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    Agglomeration both(regions, std::move(all), noise, parameters, threads);
    both.begin(std::max(marks[0], marks[1]));
    parallelParts(both.batches(), threads, [&](int batch) { both.priceBatch(batch); });
    both.run();
  }
  return collect(regions, std::move(cell_region), 0.5 * parameters.min_points, threads);
}

} // namespace pcl_mrf_planes::adaptive
