// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Upright strips of a field whose active blocks have about as many labels in each.
class ActiveStrips {
public:
  ActiveStrips(const CandidateField& field, int strips)
  : strips_(Bands(field.blocks.columns, strips).count)
  {
    const FrameVector<std::size_t> row_begin = rowBegins(field);
    const FrameVector<std::size_t> border = borders(field, row_begin);
    first_.reserve(row_begin.size() * (border.size() + 1));
    for (int row = 0; row < field.blocks.rows; ++row) {
      const auto r = static_cast<std::size_t>(row);
      std::size_t a = row_begin[r];
      for (const std::size_t column : border) {
        while (a < row_begin[r + 1] &&
               field.active[a] < field.blocks.at(0, row) + column)
          ++a;
        first_.push_back(a);
      }
      first_.push_back(row_begin[r + 1]);
    }
    first_.push_back(row_begin.back());
  }

  int count() const { return strips_; }

  /// Number of the first active block of a strip in a row of blocks, or of those after it;
  /// of row 0 to the number of rows, strip 0 to count(); strip 0 alone of the last of them.
  std::size_t first(int row, int strip) const
  {
    const int k = row * (strips_ + 1) + strip;
    return first_[static_cast<std::size_t>(k)];
  }

private:
  /// Number of the first active block of each row of blocks, or of those after it.
  static FrameVector<std::size_t> rowBegins(const CandidateField& field)
  {
    FrameVector<std::size_t> begin;
    begin.reserve(static_cast<std::size_t>(field.blocks.rows) + 1);
    std::size_t a = 0;
    for (int row = 0; row <= field.blocks.rows; ++row) {
      while (a < field.active.size() && field.active[a] < field.blocks.at(0, row))
        ++a;
      begin.push_back(a);
    }
    return begin;
  }

  /// The first column of each strip.
  FrameVector<std::size_t> borders(const CandidateField& field,
                                   const FrameVector<std::size_t>& row_begin) const
  {
    const auto columns = static_cast<std::size_t>(field.blocks.columns);
    FrameVector<std::size_t> left_of(columns + 1, 0); // labels, by column
    for (int row = 0; row < field.blocks.rows; ++row) {
      const auto r = static_cast<std::size_t>(row);
      for (std::size_t a = row_begin[r]; a < row_begin[r + 1]; ++a) {
        const std::size_t block = field.active[a];
        left_of[block - field.blocks.at(0, row) + 1] += field.blocks.count[block];
      }
    }
    for (std::size_t c = 0; c < columns; ++c)
      left_of[c + 1] += left_of[c];
    FrameVector<std::size_t> border;
    for (int strip = 0; strip < strips_; ++strip) {
      const std::size_t wanted = left_of.back() * static_cast<std::size_t>(strip) /
                                 static_cast<std::size_t>(strips_);
      border.push_back(static_cast<std::size_t>(
          std::lower_bound(left_of.begin(), left_of.end(), wanted) - left_of.begin()));
    }
    return border;
  }

  int strips_;
  FrameVector<std::size_t> first_; ///< by row of blocks and strip
};

} // namespace pcl_mrf_planes::adaptive
