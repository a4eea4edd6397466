// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/cell_runs.h"
#include "adaptive/plane_merging.h"
#include "frame_memory.h"
#include "threads.h"

#include <cstddef>
#include <optional>
#include <utility>

namespace pcl_mrf_planes::adaptive {

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

/// The spans of some rows, in a counting sort by region.
class SpanSort {
public:
  SpanSort(const TileRegions& regions, const TileLevel& cells, TileRows rows)
  : spans(regions.planes.size(), 0)
  , covered(regions.planes.size(), 0)
  , rows_(rows)
  , runs_(regions.cell_region, cells, rows)
  {
    forEachRun([&](std::size_t k, const CellRun& run, int) {
      ++spans[k];
      covered[k] += run.end - run.begin;
    });
  }

  /// Writes the spans of each region from spans[region] on, which moves on with them.
  void fill(FrameVector<Span>& out)
  {
    forEachRun([&](std::size_t k, const CellRun& run, int r) {
      out[spans[k]++] = {run.begin, run.end, r};
    });
  }

  FrameVector<std::size_t> spans; ///< of each region
  FrameVector<int> covered;       ///< cells of each region

private:
  template <typename Visit>
  void forEachRun(const Visit& visit) const
  {
    for (int r = rows_.begin; r < rows_.end; ++r)
      for (const CellRun* run = runs_.begin(r); run != runs_.end(r); ++run)
        if (run->region >= 0)
          visit(static_cast<std::size_t>(run->region), *run, r);
  }

  TileRows rows_;
  CellRuns runs_;
};

/// The cells of each region, row by row.
class RegionCells {
public:
  RegionCells(const TileRegions& regions, const TileLevel& cells, unsigned int threads)
  : starts_(regions.planes.size() + 1, 0)
  , cells_(regions.planes.size(), 0)
  {
    const Bands bands(cells.rows);
    FrameVector<std::optional<SpanSort>> parts(static_cast<std::size_t>(bands.count));
    parallelParts(bands.count, threads, [&](int band) {
      parts[static_cast<std::size_t>(band)].emplace(
          regions, cells, TileRows{bands.begin(band), bands.begin(band + 1)});
    });
    for (std::size_t k = 0; k < cells_.size(); ++k) {
      std::size_t next = starts_[k];
      for (auto& part : parts) {
        next += std::exchange(part->spans[k], next);
        cells_[k] += part->covered[k];
      }
      starts_[k + 1] = next;
    }
    spans_.resize(starts_.back());
    parallelParts(bands.count, threads, [&](int band) {
      parts[static_cast<std::size_t>(band)]->fill(spans_);
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

} // namespace pcl_mrf_planes::adaptive
