// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "adaptive/region_cells.h"
#include "adaptive/region_graph.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

struct Cell {
  int column, row;
};

/// What lies between two regions of the image.
class Gap {
public:
  /// A straight way from a cell of one region to the nearest of the other.
  struct Way {
    Cell from, to;
  };
  using Ways = FrameVector<Way>;

  Gap(const TileRegions& regions, const OrganizedPoints& points, const TileLevel& cells,
      const AdaptiveParameters& parameters, unsigned int threads)
  : points_(points)
  , side_(cells.side)
  , parameters_(parameters)
  , members_(regions, cells, threads)
  , boxes_(regions.planes.size())
  {
    parallelRows(static_cast<int>(boxes_.size()), threads, [&](int k) {
      boxes_[static_cast<std::size_t>(k)] = boxOf(members_.of(k));
    });
  }

  /// False if the gap is too wide even between the boxes around the parts.
  bool mayBeNarrow(int a, int b) const
  {
    const Box& p = boxes_[static_cast<std::size_t>(a)];
    const Box& q = boxes_[static_cast<std::size_t>(b)];
    const int dx =
        std::max({0, p.low.column - q.high.column, q.low.column - p.high.column});
    const int dy = std::max({0, p.low.row - q.high.row, q.low.row - p.high.row});
    return dx * dx + dy * dy <= widest(a, b);
  }

  /// Ways over the gap; none if it is too wide.
  Ways waysOver(int a, int b) const
  {
    constexpr int WALKS = 12;
    const SpanRange from = members_.of(a);
    const SpanRange to = members_.of(b);
    Ways ways;
    int gap = std::numeric_limits<int>::max();
    const int stride = std::max(1, from.cells / WALKS);
    int next = stride / 2; // cell to start from
    for (const Span& span : from) {
      for (; next < span.end - span.begin; next += stride) {
        const Cell cell = {span.begin + next, span.row};
        const Cell nearest = nearestOf(to, cell);
        gap = std::min(gap, squaredDistance(cell, nearest));
        ways.push_back({cell, nearest});
      }
      next -= span.end - span.begin;
    }
    if (gap > widest(a, b))
      ways.clear();
    return ways;
  }

  /// True if nothing in the gap lies behind the plane: what separates the parts stands in
  /// front, so the surface may well go on behind it.
  bool mayHidePlane(const Ways& ways, const FittedPlane& plane, double tolerance) const
  {
    Walked walked;
    for (const Way& way : ways)
      walk(plane, tolerance, way, walked);
    return walked.off_plane <= parameters_.join_seen * walked.points;
  }

private:
  struct Walked {
    int points = 0;
    int off_plane = 0;
  };

  struct Box {
    Cell low, high;
  };

  static Box boxOf(const SpanRange& spans)
  {
    constexpr int FAR = 1 << 14; // cells
    Box box = {{FAR, FAR}, {-FAR, -FAR}};
    for (const Span& span : spans) {
      box.low = {std::min(box.low.column, span.begin), std::min(box.low.row, span.row)};
      box.high = {std::max(box.high.column, span.end - 1),
                  std::max(box.high.row, span.row)};
    }
    return box;
  }

  /// Widest gap that may be joined over, squared, in cells.
  double widest(int a, int b) const
  {
    const double smaller = std::min(members_.of(a).cells, members_.of(b).cells);
    return parameters_.join_gap * parameters_.join_gap * smaller;
  }

  static int squaredDistance(const Cell& a, const Cell& b)
  {
    const int dx = a.column - b.column;
    const int dy = a.row - b.row;
    return dx * dx + dy * dy;
  }

  /// The first of the nearest cells.
  static Cell nearestOf(const SpanRange& spans, const Cell& to)
  {
    Cell nearest = {0, 0};
    int least = std::numeric_limits<int>::max();
    for (const Span& span : spans) {
      const Cell cell = {std::clamp(to.column, span.begin, span.end - 1), span.row};
      if (const int distance = squaredDistance(cell, to); distance < least) {
        least = distance;
        nearest = cell;
      }
    }
    return nearest;
  }

  int middle(int cell, int size) const
  {
    return std::min(cell * side_ + side_ / 2, size - 1);
  }

  /// One coordinate along a straight way: start + way * k / steps, without a division for
  /// each k, as it grows by no more than one.
  class Coordinate {
  public:
    Coordinate(int start, int way, int steps)
    : at_(start)
    , sign_(way < 0 ? -1 : 1)
    , length_(std::abs(way))
    , steps_(steps)
    {}

    int next()
    {
      rest_ += length_;
      if (rest_ >= steps_) {
        rest_ -= steps_;
        at_ += sign_;
      }
      return at_;
    }

  private:
    int at_, sign_, length_, steps_;
    int rest_ = 0;
  };

  /// Counts the points on the straight way between the middles of two cells.
  void walk(const FittedPlane& plane, double tolerance, const Way& way,
            Walked& walked) const
  {
    const int u0 = middle(way.from.column, points_.width);
    const int v0 = middle(way.from.row, points_.height);
    const int du = middle(way.to.column, points_.width) - u0;
    const int dv = middle(way.to.row, points_.height) - v0;
    const int steps = std::max(std::abs(du), std::abs(dv));
    Coordinate u(u0, du, steps);
    Coordinate v(v0, dv, steps);
    for (int k = 1; k < steps; ++k) {
      const auto row = static_cast<std::size_t>(v.next());
      const std::size_t i = row * static_cast<std::size_t>(points_.width) +
                            static_cast<std::size_t>(u.next());
      if (points_.valid[i] == 0)
        continue;
      ++walked.points;
      const double distance = plane.distance(points_.x[i], points_.y[i], points_.z[i]);
      const bool in_front = distance > tolerance;
      if (distance < -tolerance || (in_front && !parameters_.join_over_occluders))
        ++walked.off_plane;
    }
  }

  const OrganizedPoints& points_;
  int side_;
  const AdaptiveParameters& parameters_;
  RegionCells members_;
  FrameVector<Box> boxes_;
};

} // namespace

namespace {

/// Two parts, and their plane as if there were no others.
struct CoplanarPair {
  Candidate parts;
  FittedPlane joint;
  Gap::Ways ways; ///< between them
  bool may_hide;  ///< whether the gap may hide the plane
};

/// Joins parts of planes, the most alike first.
class CoplanarJoining {
public:
  CoplanarJoining(TileRegions& parts, const OrganizedPoints& points,
                  const TileLevel& cells, const NoiseLaw& noise,
                  const AdaptiveParameters& parameters, unsigned int threads)
  : noise_(noise)
  , parameters_(parameters)
  , limit_(parameters.join_tolerance * parameters.join_tolerance)
  , gap_(parts, points, cells, parameters, threads)
  // Sums and planes only; which region a cell is of is still wanted.
  , regions_(std::move(static_cast<FittedRegions&>(parts)))
  , bands_(regions_.size())
  , found_(static_cast<std::size_t>(bands_.count))
  {
    parallelParts(bands_.count, threads, [&](int band) {
      for (int a = bands_.begin(band); a < bands_.begin(band + 1); ++a)
        findPairs(a, found_[static_cast<std::size_t>(band)]);
    });
  }

  Regions& run()
  {
    for (CoplanarPair* pair : sorted()) {
      const int a = regions_.find(pair->parts.a);
      const int b = regions_.find(pair->parts.b);
      if (a == b)
        continue;
      const bool grew = regions_.tiles(a) + regions_.tiles(b) > pair->parts.tiles;
      if (grew && !(fits(a, b, pair->joint) >= 0))
        continue;
      if (grew)
        pair->may_hide = mayHide(pair->ways, pair->joint);
      if (pair->may_hide)
        regions_.merge(a, b, pair->joint);
    }
    return regions_;
  }

private:
  /// \return what it costs to join two sets; negative: they are not one plane
  double fits(int a, int b, FittedPlane& joint) const
  {
    joint = fitSums(regions_.sums(a) + regions_.sums(b));
    const double cost =
        dissimilarity(regions_.plane(a), regions_.plane(b), joint, noise_, parameters_);
    return cost <= limit_ ? cost : -1;
  }

  bool mayHide(const Gap::Ways& ways, const FittedPlane& joint) const
  {
    constexpr double BEHIND = 3.0; // sigmas
    return gap_.mayHidePlane(
        ways, joint, BEHIND * std::sqrt(allowedVariance(joint, noise_, parameters_)));
  }

  /// Pairs of a part and one after it.
  void findPairs(int a, FrameVector<CoplanarPair>& found) const
  {
    constexpr double LEAST_COSINE = 0.9; // of the normals: spares most of the fits
    FittedPlane joint;
    for (int b = a + 1; b < regions_.size(); ++b) {
      if (regions_.plane(a).normal.dot(regions_.plane(b).normal) < LEAST_COSINE ||
          !gap_.mayBeNarrow(a, b))
        continue;
      const double cost = fits(a, b, joint);
      if (!(cost >= 0))
        continue;
      Gap::Ways ways = gap_.waysOver(a, b);
      if (ways.empty())
        continue;
      const bool may_hide = mayHide(ways, joint);
      const int tiles = regions_.tiles(a) + regions_.tiles(b);
      found.push_back({{cost, a, b, tiles}, joint, std::move(ways), may_hide});
    }
  }

  FrameVector<CoplanarPair*> sorted()
  {
    FrameVector<CoplanarPair*> pairs;
    for (FrameVector<CoplanarPair>& some : found_)
      for (CoplanarPair& pair : some)
        pairs.push_back(&pair);
    std::sort(pairs.begin(), pairs.end(),
              [](const CoplanarPair* p, const CoplanarPair* q) {
                return q->parts < p->parts;
              });
    return pairs;
  }

  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  double limit_;
  Gap gap_;
  Regions regions_;
  Bands bands_;
  FrameVector<FrameVector<CoplanarPair>> found_; ///< in bands of the first part
};

} // namespace

TileRegions joinCoplanar(TileRegions parts, const OrganizedPoints& points,
                         const TileLevel& cells, const NoiseLaw& noise,
                         const AdaptiveParameters& parameters, unsigned int threads)
{
  CoplanarJoining joining(parts, points, cells, noise, parameters, threads);
  return collect(joining.run(), std::move(parts.cell_region),
                 0.5 * parameters.min_points, threads);
}

} // namespace pcl_mrf_planes::adaptive
