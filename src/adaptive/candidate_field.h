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
  std::vector<std::uint8_t> count;   ///< labels in use; 1: the block is settled

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

/// "No plane" and the planes with cells in a block or at most so many cells away from it,
/// the nearest first. O(blocks * reach^2)
CandidateBlocks findCandidates(const TileRegions& regions, const TileLevel& cells,
                               int width, int height, int reach,
                               unsigned int threads = 1);

/// The same in the memory of another one.
void findCandidates(const TileRegions& regions, const TileLevel& cells, int width,
                    int height, int reach, unsigned int threads, CandidateBlocks& out);

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

/// Potts weights of the edges of a block.
struct BlockWeights {
  static constexpr std::size_t SIDE = CandidateBlocks::SIDE;
  std::array<BlockRow, SIDE> right; ///< by row: to the point on the right; 0: no edge
  std::array<BlockRow, SIDE> down;  ///< by row: to the point below
  BlockRow above;                   ///< from the first row to the points above
  BlockRow left;                    ///< from the first column to the left, by row
};

/// Data costs and Potts weights of the random field, in whole units so small that the
/// largest sum, a data cost and four messages, just stays below 2^15.
///
/// Only blocks with a choice have costs. A block is settled, with one label left, where
/// that label is better than any other at every point by more than what neighbours of any
/// labels could make up for.
struct CandidateField {
  static constexpr std::size_t SETTLED = SIZE_MAX;
  int width = 0;
  int height = 0;
  CandidateBlocks blocks;
  std::vector<std::size_t> active;  ///< blocks with a choice, row by row
  std::vector<std::size_t> number;  ///< of each block in active, or SETTLED
  std::vector<std::size_t> first;   ///< where each active block's costs are in data
  std::vector<BlockRow> data;       ///< by active block, row and slot
  std::vector<BlockWeights> weight; ///< by active block

  /// Costs of a row of an active block, slot by slot.
  std::size_t dataRow(std::size_t active_block, std::size_t row) const
  {
    return first[active_block] + row * blocks.count[active[active_block]];
  }
};

/// The active blocks of a part of a field.
struct FieldPart {
  std::vector<std::size_t> active;
  std::vector<std::size_t> first; ///< in data of the part
  std::vector<BlockRow> data;
  std::vector<BlockWeights> weight;
};

/// A field and the memory that it is made in.
struct FieldMemory {
  CandidateField field;
  std::vector<FieldPart> parts;
  std::vector<float> ranges; ///< of the points, where they count
};

/// What a row of a block has received for one label.
struct Messages {
  BlockRow::Numbers from[4] = {}; ///< by the side that the sender is at
};

/// An active block among its neighbours.
struct ActiveBlock {
  static constexpr std::size_t SIDES = 4;
  using SlotMap = std::array<std::uint8_t, CandidateBlocks::SLOTS>;

  std::size_t count;            ///< labels
  std::size_t first;            ///< costs of its first row
  std::size_t neighbour[SIDES]; ///< active block on each side, or SETTLED
  SlotMap
      slot[SIDES]; ///< where its labels, if it is active, are among those of this one
};

/// Memory of belief propagation.
struct BeliefMemory {
  std::vector<Messages> received;
  std::vector<ActiveBlock> places; ///< of the active blocks
};

/// Whole units of the field's costs in one sigma.
double unitsPerSigma(const AdaptiveParameters& parameters);

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters,
                          unsigned int threads = 1);

/// The same in the memory of another one.
void buildField(const OrganizedPoints& points, const TileRegions& regions,
                const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, unsigned int threads,
                FieldMemory& memory);

/// Min-sum loopy belief propagation; label per site, 0 = none.
///
/// Each of the passes goes down the image and up again, a row at a time: messages to the next
/// row are used at once, so they cross the image in one pass; those within a row move by
/// one point a pass. A Potts message needs the least belief only: O(sites * labels of a
/// block) an iteration. Settled blocks send what they are sure of, once. Threads share the
/// rows, each follows the one to its left.
std::vector<std::uint16_t> propagateBeliefs(const CandidateField& field,
                                            const OrganizedPoints& points, int passes,
                                            unsigned int threads = 1);

/// The same in memory that is there already.
void propagateBeliefs(const CandidateField& field, const OrganizedPoints& points,
                      int passes, unsigned int threads, BeliefMemory& memory,
                      std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes::adaptive
