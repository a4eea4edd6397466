// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/cell_runs.h"
#include "adaptive/plane_merging.h"
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

/// Some cells of a row, half open.
struct Span {
  int begin, end, row;
};

/// Cells of a region, in runs that follow each other in memory.
struct SpanRange {
  const Span* first;
  const Span* last; ///< one past the end
  int cells;

  const Span* begin() const { return first; }
  const Span* end() const { return last; }
};

/// The cells of each region, row by row.
class RegionCells {
public:
  RegionCells(const TileRegions& regions, const TileLevel& cells)
  : starts_(regions.planes.size() + 1, 0)
  , cells_(regions.planes.size(), 0)
  {
    const CellRuns runs(regions.cell_region, cells, {0, cells.rows});
    const auto forEachRun = [&](const auto& visit) {
      for (int r = 0; r < cells.rows; ++r)
        for (const CellRun* run = runs.begin(r); run != runs.end(r); ++run)
          if (run->region >= 0)
            visit(static_cast<std::size_t>(run->region), *run, r);
    };
    // Counting sort; where a region is to start is where it ends once it is filled.
    FrameVector<std::size_t> filled(starts_);
    forEachRun([&](std::size_t k, const CellRun& run, int) {
      ++filled[k];
      cells_[k] += run.end - run.begin;
    });
    for (std::size_t k = 0; k + 1 < starts_.size(); ++k) {
      starts_[k + 1] = starts_[k] + filled[k];
      filled[k] = starts_[k];
    }
    spans_.resize(starts_.back());
    forEachRun([&](std::size_t k, const CellRun& run, int r) {
      spans_[filled[k]++] = {run.begin, run.end, r};
    });
  }

  SpanRange of(int region) const
  {
    const auto k = static_cast<std::size_t>(region);
    return {spans_.data() + starts_[k], spans_.data() + starts_[k + 1], cells_[k]};
  }

private:
  FrameVector<std::size_t> starts_;
  FrameVector<int> cells_; ///< number of each region's
  FrameVector<Span> spans_;
};

/// What lies between two regions of the image.
class Gap {
public:
  Gap(const TileRegions& regions, const OrganizedPoints& points, const TileLevel& cells,
      const AdaptiveParameters& parameters)
  : points_(points)
  , side_(cells.side)
  , parameters_(parameters)
  , members_(regions, cells)
  {
    const auto count = static_cast<int>(regions.planes.size());
    boxes_.reserve(regions.planes.size());
    for (int k = 0; k < count; ++k)
      boxes_.push_back(boxOf(members_.of(k)));
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

  /// True if the gap is not wide and nothing in it lies behind the plane: what separates
  /// the parts stands in front, so the surface may well go on behind it.
  bool mayHidePlane(int a, int b, const FittedPlane& plane, double tolerance) const
  {
    constexpr int WALKS = 12;
    const SpanRange from = members_.of(a);
    const SpanRange to = members_.of(b);
    FrameVector<Way> ways;
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
      return false;
    Walked walked;
    for (const Way& way : ways)
      walk(plane, tolerance, way, walked);
    return walked.off_plane <= parameters_.join_seen * walked.points;
  }

private:
  struct Way {
    Cell from, to;
  };

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

TileRegions joinCoplanar(TileRegions parts, const OrganizedPoints& points,
                         const TileLevel& cells, const NoiseLaw& noise,
                         const AdaptiveParameters& parameters, unsigned int threads)
{
  constexpr double LEAST_COSINE = 0.9; // of the normals: spares most of the fits
  constexpr double BEHIND = 3.0;       // sigmas
  const double limit = parameters.join_tolerance * parameters.join_tolerance;
  const Gap gap(parts, points, cells, parameters);
  // Sums and planes only; which region a cell is of is still wanted below.
  Regions regions(std::move(static_cast<FittedRegions&>(parts)));
  const auto jointOf = [&](int a, int b) {
    return fitSums(regions.sums(a) + regions.sums(b));
  };
  const auto cost = [&](int a, int b, const FittedPlane& joint) {
    return dissimilarity(regions.plane(a), regions.plane(b), joint, noise, parameters);
  };

  const Bands bands(regions.size());
  FrameVector<FrameVector<Candidate>> found(static_cast<std::size_t>(bands.count));
  parallelParts(bands.count, threads, [&](int band) {
    for (int a = bands.begin(band); a < bands.begin(band + 1); ++a)
      for (int b = a + 1; b < regions.size(); ++b) {
        if (regions.plane(a).normal.dot(regions.plane(b).normal) < LEAST_COSINE ||
            !gap.mayBeNarrow(a, b))
          continue;
        const double c = cost(a, b, jointOf(a, b));
        if (c >= 0 && c <= limit)
          found[static_cast<std::size_t>(band)].push_back({c, a, b, 0});
      }
  });
  FrameVector<Candidate> pairs;
  for (const FrameVector<Candidate>& some : found)
    pairs.insert(pairs.end(), some.begin(), some.end());
  std::sort(pairs.begin(), pairs.end(),
            [](const Candidate& p, const Candidate& q) { return q < p; });

  for (const Candidate& pair : pairs) {
    const int a = regions.find(pair.a);
    const int b = regions.find(pair.b);
    if (a == b)
      continue;
    const FittedPlane joint = jointOf(a, b);
    const double c = cost(a, b, joint); // either may have grown since
    if (c < 0 || c > limit)
      continue;
    const double tolerance =
        BEHIND * std::sqrt(allowedVariance(joint, noise, parameters));
    if (gap.mayHidePlane(pair.a, pair.b, joint, tolerance))
      regions.merge(a, b, joint);
  }
  return collect(regions, std::move(parts.cell_region), 0.5 * parameters.min_points,
                 threads);
}

} // namespace pcl_mrf_planes::adaptive
