// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Labels that may compete in each block of pixels: "no plane" (0) and the planes
/// (region + 1) with tiles in the neighbourhood, so that no plane paints a stripe where
/// it has no support.
struct CandidateBlocks {
  static constexpr int SIDE = 8;          ///< of a block, points
  static constexpr std::size_t SLOTS = 8; ///< labels that a block can have
  int columns = 0;
  int rows = 0;
  std::vector<std::uint16_t> labels; ///< SLOTS a block
  std::vector<std::uint8_t> count;   ///< labels in use, "no plane" among them

  std::size_t at(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  const std::uint16_t* labelsOf(std::size_t block) const
  {
    return &labels[block * SLOTS];
  }
};

CandidateBlocks findCandidates(const TileRegions& regions, const TileLevel& cells,
                               int width, int height);

/// A row of a block: eight numbers, added and compared by single instructions wherever the
/// compiler knows some (an extension of g++ and clang++).
struct BlockRow {
  using Numbers __attribute__((vector_size(16))) = std::int16_t;
  Numbers v = {};
};

inline BlockRow::Numbers least(BlockRow::Numbers a, BlockRow::Numbers b)
{
  return a < b ? a : b;
}

/// Data costs and Potts weights of the random field, block by block, in whole units so
/// small that the largest sum, a data cost and four messages, just stays below 2^15.
struct CandidateField {
  int width = 0;
  int height = 0;
  CandidateBlocks blocks;
  std::vector<std::size_t> first;  ///< where the first row of each block is in data
  std::vector<std::size_t> stride; ///< from there to the block's next row
  std::vector<BlockRow> data;      ///< by row of the image, block and slot
  std::vector<BlockRow> right; ///< weight to the right: SIDE rows a block; 0: no edge
  std::vector<BlockRow> down;  ///< weight to the point below

  std::size_t dataRow(std::size_t block, int row) const
  {
    return first[block] + static_cast<std::size_t>(row) * stride[block];
  }
  static std::size_t weightRow(std::size_t block, int row)
  {
    return block * static_cast<std::size_t>(CandidateBlocks::SIDE) +
           static_cast<std::size_t>(row);
  }
};

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const TileLevel& cells, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters);

/// Min-sum loopy belief propagation; label per site, 0 = none.
///
/// Each of the passes goes down the image and up again, a row at a time: messages to the next
/// row are used at once, so they cross the image in one pass; those within a row move by
/// one point a pass. A Potts message needs the least belief only: O(sites * labels of a
/// block) an iteration.
std::vector<std::uint16_t> propagateBeliefs(const CandidateField& field,
                                            const OrganizedPoints& points, int passes);

} // namespace pcl_mrf_planes::adaptive
