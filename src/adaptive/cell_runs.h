// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/tile_pyramid.h"
#include "frame_memory.h"

#include <cstddef>

namespace pcl_mrf_planes::adaptive {

/// Cells of one region that lie side by side in a row, half open.
struct CellRun {
  int begin, end;
  int region; ///< -1: none
};

/// The cells of some rows in runs, which cover each row from its left to its right: a tenth
/// of the cells in number where surfaces are large.
class CellRuns {
public:
  /// O(cells of the rows)
  CellRuns(const FrameVector<int>& cell_region, const TileLevel& cells, TileRows rows)
  : first_(rows.begin)
  {
    starts_.reserve(static_cast<std::size_t>(rows.end - rows.begin) + 1);
    starts_.push_back(0);
    for (int r = rows.begin; r < rows.end; ++r) {
      addRow(&cell_region[cells.at(0, r)], cells.columns);
      starts_.push_back(runs_.size());
    }
  }

  /// The runs of row \a r and, one past the end, the first of the next.
  const CellRun* begin(int r) const { return runs_.data() + start(r); }
  const CellRun* end(int r) const { return runs_.data() + start(r + 1); }

  /// Of all rows.
  std::size_t size() const { return runs_.size(); }

private:
  void addRow(const int* region, int columns)
  {
    int begin = 0;
    for (int c = 1; c < columns; ++c)
      if (region[c] != region[c - 1]) {
        runs_.push_back({begin, c, region[begin]});
        begin = c;
      }
    if (columns > 0)
      runs_.push_back({begin, columns, region[begin]});
  }

  std::size_t start(int r) const
  {
    return starts_[static_cast<std::size_t>(r - first_)];
  }

  int first_; ///< row
  FrameVector<std::size_t> starts_;
  FrameVector<CellRun> runs_;
};

} // namespace pcl_mrf_planes::adaptive
