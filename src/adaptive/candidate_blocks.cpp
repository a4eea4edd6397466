// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int CELLS = CandidateBlocks::SIDE / CELL; // of a block, each way

/// Finds the regions around a block.
class Surroundings {
public:
  Surroundings(const TileRegions& regions, const TileLevel& cells, int reach)
  : regions_(regions)
  , cells_(cells)
  , reach_(reach)
  {}

  /// Looks at a row of blocks: before its blocks.
  void lookAtRow(int block_row)
  {
    row_ = block_row * CELLS;
    top_ = std::max(0, row_ - reach_);
    bottom_ = std::min(cells_.rows, row_ + CELLS + reach_);
    const auto columns = static_cast<std::size_t>(cells_.columns);
    const int* const first = &regions_.cell_region[cells_.at(0, row_)];
    differ_.assign(columns, 0);
    for (int r = top_; r < bottom_; ++r) {
      const int* const region = &regions_.cell_region[cells_.at(0, r)];
      for (std::size_t c = 0; c < columns; ++c)
        differ_[c] |= region[c] ^ first[c];
    }
  }

  /// Looks at the cells of a block of the row and so many around it.
  void look(int block_column)
  {
    column_ = block_column * CELLS;
    left_ = std::max(0, column_ - reach_);
    right_ = std::min(cells_.columns, column_ + CELLS + reach_);
  }

  /// The one region of all cells, -1 for none; unless they differ.
  bool isUniform(int& region) const
  {
    const int* const of_row = &regions_.cell_region[cells_.at(0, row_)];
    region = of_row[column_];
    int differ = 0;
    for (int c = left_; c < right_; ++c)
      differ |= differ_[static_cast<std::size_t>(c)] | (of_row[c] ^ region);
    return differ == 0;
  }

  /// Distances in cells and regions, the nearest first.
  const FrameVector<std::pair<int, int>>& regions()
  {
    found_.clear();
    for (int r = top_; r < bottom_; ++r) {
      const int* const region = &regions_.cell_region[cells_.at(0, r)];
      const int rows = distance({r, r + 1}, row_);
      for (int first = left_, end = left_; first < right_; first = end) {
        while (++end < right_ && region[end] == region[first])
          ;
        if (region[first] >= 0)
          note(region[first], std::max(rows, distance({first, end}, column_)));
      }
    }
    std::sort(found_.begin(), found_.end());
    return found_;
  }

private:
  /// Neighbouring cells of a row or a column, half open.
  struct Stretch {
    int begin, end;
  };

  /// From the cells of the block along one way, the first of which is given.
  static int distance(Stretch cells, int block)
  {
    return std::max({0, block - (cells.end - 1), cells.begin - (block + CELLS - 1)});
  }

  void note(int id, int distance)
  {
    for (auto& [d, region] : found_)
      if (region == id) {
        d = std::min(d, distance);
        return;
      }
    found_.emplace_back(distance, id);
  }

  const TileRegions& regions_;
  const TileLevel& cells_;
  int reach_;
  int column_ = 0, row_ = 0;                        ///< first cell of the block
  int left_ = 0, right_ = 0, top_ = 0, bottom_ = 0; ///< cells around it, half open
  FrameVector<int>
      differ_; ///< by column of the row: not 0 where its cells are not one region
  FrameVector<std::pair<int, int>> found_;
};

} // namespace

CandidateBlocks findCandidates(const TileRegions& regions, const TileLevel& cells,
                               int width, int height, int reach, unsigned int threads)
{
  CandidateBlocks out;
  findCandidates(regions, cells, width, height, reach, threads, out);
  return out;
}

void findCandidates(const TileRegions& regions, const TileLevel& cells, int width,
                    int height, int reach, unsigned int threads, CandidateBlocks& out)
{
  constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
  out.columns = (width + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  out.rows = (height + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  out.count.assign(out.at(0, out.rows), 1);
  out.labels.assign(out.count.size() * SLOTS, 0);
  const auto add = [&](std::size_t block, int region) {
    out.labels[block * SLOTS + out.count[block]++] =
        static_cast<std::uint16_t>(region + 1);
  };
  const auto addAround = [&](Surroundings& around, int c, int r) {
    const std::size_t block = out.at(c, r);
    around.look(c);
    if (int region = -1; around.isUniform(region)) {
      if (region >= 0)
        add(block, region);
      return;
    }
    for (const auto& [distance, region] : around.regions())
      if (out.count[block] < SLOTS)
        add(block, region);
  };
  const Bands bands(out.rows);
  parallelParts(bands.count, threads, [&](int band) {
    Surroundings around(regions, cells, reach);
    for (int r = bands.begin(band); r < bands.begin(band + 1); ++r) {
      around.lookAtRow(r);
      for (int c = 0; c < out.columns; ++c)
        addAround(around, c, r);
    }
  });
}

} // namespace pcl_mrf_planes::adaptive
