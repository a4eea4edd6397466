// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/cell_runs.h"
#include "adaptive/cost_queue.h"
#include "adaptive/flatness.h"
#include "adaptive/region_graph.h"
#include "frame_memory.h"
#include "threads.h"

#include <boost/container/static_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// Links the regions on either side of the border above a row of cells.
/// \return their roots, in order
FrameVector<int> linkAcross(const FrameVector<int>& cell_region, const TileLevel& cells,
                            int row, Regions& regions)
{
  FrameVector<int> linked;
  for (int c = 0; c < cells.columns; ++c) {
    const int above = cell_region[cells.at(c, row - 1)];
    const int below = cell_region[cells.at(c, row)];
    if (above < 0 || below < 0)
      continue;
    linked.push_back(regions.find(above));
    linked.push_back(regions.find(below));
    regions.touch(linked[linked.size() - 2], linked.back());
  }
  std::sort(linked.begin(), linked.end());
  linked.erase(std::unique(linked.begin(), linked.end()), linked.end());
  return linked;
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
                const AdaptiveParameters& parameters)
  : regions_(regions)
  , tiles_(std::move(tiles))
  , noise_(noise)
  , parameters_(parameters)
  , limit_(parameters.merge_tolerance * parameters.merge_tolerance)
  , queue_(static_cast<float>(limit_))
  , offered_(static_cast<std::size_t>(regions.size()), 0)
  {
    pairs_.reserve(PAIRS * tiles_.size());
    joint_.reserve(PAIRS * tiles_.size());
  }

  /// Offers all pairs of neighbours, to be priced by priceBatch().
  void begin() { findPairs(tiles_); }

  /// The same where pairs without any of these regions, in order, are known to be no planes.
  /// \param[in] mark walks before this one
  void beginWith(const FrameVector<int>& regions, int mark)
  {
    mark_ = mark;
    for (const int a : tiles_)
      offered_[static_cast<std::size_t>(a)] = regions_.tiles(a);
    for (const int a : regions)
      offered_[static_cast<std::size_t>(a)] = 0;
    findPairs(regions);
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

  /// Merges while any pair on offer is one plane, all of which have their price, and offers
  /// what has grown: what was too different may fit it.
  void merge()
  {
    if (!mergePriced()) {
      pairs_.clear();
      return;
    }
    tiles_.erase(std::remove_if(tiles_.begin(), tiles_.end(),
                                [&](int a) { return !regions_.isRoot(a); }),
                 tiles_.end());
    findPairs(tiles_);
  }

  /// Walks so far.
  int mark() const { return mark_; }

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

  /// Offers all pairs of neighbours whose first is one of these, but for those that neither
  /// has grown since they were found too different.
  void findPairs(const FrameVector<int>& regions)
  {
    pairs_.clear();
    for (const int a : regions)
      regions_.forEachNeighbour(a, ++mark_, [&](int b) {
        if (a < b && (grew(a) || grew(b)))
          pairs_.push_back({a, b, regions_.tiles(a) + regions_.tiles(b), 0.0F});
      });
    for (const int a : regions)
      offered_[static_cast<std::size_t>(a)] = regions_.tiles(a);
    joint_.resize(std::max(joint_.size(), pairs_.size()));
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
    joint_.resize(std::max(joint_.size(), pairs_.size()));
    price(looked_at_, pairs_.size());
    queueNew();
  }

  static constexpr std::size_t AT_ONCE = 64; ///< pairs that stay in the nearest cache

  /// Fits the planes of pairs, at most AT_ONCE, and tells what it costs to merge them.
  void price(std::size_t first, std::size_t last)
  {
    boost::container::static_vector<TileSums, AT_ONCE> sums;
    for (std::size_t k = first; k < last; ++k)
      sums.push_back(regions_.sums(pairs_[k].a) + regions_.sums(pairs_[k].b));
    if (first < last)
      fitPlanes(sums.data(), sums.size(), &joint_[first]);
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
  FrameVector<int> tiles_; ///< those that have not been merged into another
  int mark_ = 0;           ///< of the last walk through neighbours
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  double limit_;
  CostQueue queue_;
  FrameVector<int> offered_;       ///< tiles of each region when it was last offered
  FrameVector<Pair> pairs_;        ///< in the order in which they were offered
  FrameVector<FittedPlane> joint_; ///< plane of both
  std::size_t looked_at_ = 0;      ///< so many pairs, the first
};

using Group = std::optional<Agglomeration>;
using Groups = FrameVector<Group>;

/// Merges in groups of regions that are no neighbours of those in other groups. Some have
/// more to merge than others: pairs of all groups are priced together.
/// \return walks so far
int mergeAll(Groups& groups, unsigned int threads)
{
  struct Batch {
    Agglomeration* group;
    int number;
  };
  FrameVector<Batch> batches;
  while (true) {
    batches.clear();
    for (Group& group : groups)
      for (int number = 0; number < group->batches(); ++number)
        batches.push_back({&*group, number});
    if (batches.empty())
      break;
    parallelParts(static_cast<int>(batches.size()), threads, [&](int k) {
      const Batch& batch = batches[static_cast<std::size_t>(k)];
      batch.group->priceBatch(batch.number);
    });
    parallelParts(static_cast<int>(groups.size()), threads, [&](int k) {
      Group& group = groups[static_cast<std::size_t>(k)];
      if (group->batches() > 0)
        group->merge();
    });
  }
  int walks = 0;
  for (const Group& group : groups)
    walks = std::max(walks, group->mark());
  return walks;
}

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
  Groups inside(static_cast<std::size_t>(halves.count));
  parallelParts(halves.count, threads, [&](int half) {
    Group& group = inside[static_cast<std::size_t>(half)];
    group.emplace(regions, tilesIn(cell_region, cells, rows(half), count), noise,
                  parameters);
    group->begin();
  });
  const int walks = mergeAll(inside, threads);
  if (halves.count > 1) {
    inside.clear();
    const FrameVector<int> linked =
        linkAcross(cell_region, cells, rows(1).begin, regions);
    FrameVector<int> roots;
    for (int tile = 0; tile < regions.size(); ++tile)
      if (regions.isRoot(tile))
        roots.push_back(tile);
    Groups both(1);
    both[0].emplace(regions, std::move(roots), noise, parameters);
    both[0]->beginWith(linked, walks);
    mergeAll(both, threads);
  }
  return collect(regions, std::move(cell_region), 0.5 * parameters.min_points, threads);
}

} // namespace pcl_mrf_planes::adaptive
