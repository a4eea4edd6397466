// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int CELLS = CandidateBlocks::SIDE / CELL; // of a block, each way
constexpr int REACH = 2;                            // blocks
constexpr int MIXED = -2;

/// Region of the cells of a rectangle, or MIXED; half open ranges.
int regionOf(const TileRegions& regions, const TileLevel& cells, int c0, int c1, int r0,
             int r1)
{
  const int first = regions.cell_region[cells.at(c0, r0)];
  for (int r = r0; r < r1; ++r)
    for (int c = c0; c < c1; ++c)
      if (regions.cell_region[cells.at(c, r)] != first)
        return MIXED;
  return first;
}

/// Region of every block.
std::vector<int> blockRegions(const TileRegions& regions, const TileLevel& cells,
                              const CandidateBlocks& blocks)
{
  std::vector<int> region;
  region.reserve(blocks.count.size());
  for (int r = 0; r < blocks.rows; ++r)
    for (int c = 0; c < blocks.columns; ++c)
      region.push_back(regionOf(regions, cells, c * CELLS,
                                std::min(cells.columns, (c + 1) * CELLS), r * CELLS,
                                std::min(cells.rows, (r + 1) * CELLS)));
  return region;
}

/// Region of every block that is all of one region as far as REACH, else MIXED: first
/// along the rows, then along the columns.
std::vector<int> uniformRegions(const std::vector<int>& region,
                                const CandidateBlocks& blocks)
{
  std::vector<int> along(region.size());
  std::vector<int> uniform(region.size());
  for (int r = 0; r < blocks.rows; ++r)
    for (int c = 0; c < blocks.columns; ++c) {
      int all = region[blocks.at(c, r)];
      for (int i = std::max(0, c - REACH); i <= std::min(blocks.columns - 1, c + REACH);
           ++i)
        all = region[blocks.at(i, r)] == all ? all : MIXED;
      along[blocks.at(c, r)] = all;
    }
  for (int r = 0; r < blocks.rows; ++r)
    for (int c = 0; c < blocks.columns; ++c) {
      int all = along[blocks.at(c, r)];
      for (int j = std::max(0, r - REACH); j <= std::min(blocks.rows - 1, r + REACH); ++j)
        all = along[blocks.at(c, j)] == all ? all : MIXED;
      uniform[blocks.at(c, r)] = all;
    }
  return uniform;
}

/// The regions that a block's own cells belong to.
struct BlockRegions {
  static constexpr std::size_t MOST = CELLS * CELLS;
  std::array<int, MOST> region;
  std::size_t count = 0;

  void add(int id)
  {
    for (std::size_t k = 0; k < count; ++k)
      if (region[k] == id)
        return;
    region[count++] = id;
  }
};

std::vector<BlockRegions> listRegions(const TileRegions& regions, const TileLevel& cells,
                                      const CandidateBlocks& blocks)
{
  std::vector<BlockRegions> lists(blocks.count.size());
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c)
      if (const int id = regions.cell_region[cells.at(c, r)]; id >= 0)
        lists[blocks.at(c / CELLS, r / CELLS)].add(id);
  return lists;
}

/// Regions near a block with their distances in blocks, the nearest first.
class Nearby {
public:
  Nearby(const std::vector<BlockRegions>& lists, const CandidateBlocks& blocks)
  : lists_(lists)
  , blocks_(blocks)
  {}

  const std::vector<std::pair<int, int>>& find(int column, int row)
  {
    found_.clear();
    for (int r = std::max(0, row - REACH); r <= std::min(blocks_.rows - 1, row + REACH);
         ++r)
      for (int c = std::max(0, column - REACH);
           c <= std::min(blocks_.columns - 1, column + REACH); ++c) {
        const BlockRegions& list = lists_[blocks_.at(c, r)];
        for (std::size_t k = 0; k < list.count; ++k)
          note(list.region[k], std::max(std::abs(c - column), std::abs(r - row)));
      }
    std::sort(found_.begin(), found_.end());
    return found_;
  }

private:
  void note(int id, int distance)
  {
    for (auto& [d, region] : found_)
      if (region == id) {
        d = std::min(d, distance);
        return;
      }
    found_.emplace_back(distance, id);
  }

  const std::vector<BlockRegions>& lists_;
  const CandidateBlocks& blocks_;
  std::vector<std::pair<int, int>> found_; ///< distance, region
};

} // namespace

CandidateBlocks findCandidates(const TileRegions& regions, const TileLevel& cells,
                               int width, int height)
{
  constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
  CandidateBlocks out;
  out.columns = (width + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  out.rows = (height + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  out.count.assign(out.at(0, out.rows), 1);
  out.labels.assign(out.count.size() * SLOTS, 0);
  const std::vector<int> uniform =
      uniformRegions(blockRegions(regions, cells, out), out);
  const std::vector<BlockRegions> lists = listRegions(regions, cells, out);
  Nearby nearby(lists, out);
  const auto add = [&](std::size_t block, int region) {
    out.labels[block * SLOTS + out.count[block]++] =
        static_cast<std::uint16_t>(region + 1);
  };
  for (int r = 0; r < out.rows; ++r)
    for (int c = 0; c < out.columns; ++c) {
      const std::size_t b = out.at(c, r);
      if (uniform[b] >= 0)
        add(b, uniform[b]);
      if (uniform[b] != MIXED)
        continue;
      for (const auto& [distance, region] : nearby.find(c, r))
        if (out.count[b] < SLOTS)
          add(b, region);
    }
  return out;
}

} // namespace pcl_mrf_planes::adaptive
