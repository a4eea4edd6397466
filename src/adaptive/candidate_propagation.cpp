// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"

#include <algorithm>
#include <array>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t LAST = SIDE - 1;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
constexpr std::uint8_t ABSENT = 255; ///< the neighbour has no such label

enum Side { LEFT, RIGHT, ABOVE, BELOW, SIDES };

using Beliefs = std::array<BlockRow, SLOTS>;
using SlotMap = std::array<std::uint8_t, SLOTS>;

/// What a row of a block has received for one label.
struct Messages {
  BlockRow::Numbers from[SIDES] = {}; ///< by the side that the sender is at
};

/// Every number moves to the right by one.
BlockRow::Numbers shiftRight(BlockRow::Numbers v, std::int16_t first)
{
  return BlockRow::Numbers{first, v[0], v[1], v[2], v[3], v[4], v[5], v[6]};
}

/// Every number moves to the left by one.
BlockRow::Numbers shiftLeft(BlockRow::Numbers v, std::int16_t last)
{
  return BlockRow::Numbers{v[1], v[2], v[3], v[4], v[5], v[6], v[7], last};
}

/// Passes over the image, with the messages that every point has received.
class Passes {
public:
  explicit Passes(const CandidateField& field)
  : f_(field)
  , blocks_(field.blocks)
  {
    received_.resize(field.data.size());
    findSlotMaps();
    for (std::size_t block = 0; block < blocks_.count.size(); ++block)
      settled_.push_back(isSettled(block));
  }

  /// One pass: messages within each row, and on to the next row. Settled blocks send their
  /// messages in the first two passes; later ones would not differ by much.
  void run(bool downwards)
  {
    ++passes_;
    for (int k = 0; k < f_.height; ++k) {
      const int y = downwards ? k : f_.height - 1 - k;
      for (int column = 0; column < blocks_.columns; ++column)
        if (passes_ <= 2 || !settled_[blocks_.at(column, y / SIDE)])
          send(column, y / SIDE, y % SIDE, downwards ? BELOW : ABOVE);
    }
  }

  /// Data costs plus all messages of a row of a block.
  void beliefs(std::size_t block, int row, Beliefs& total) const
  {
    const std::size_t start = f_.dataRow(block, row);
    for (std::size_t s = 0; s < blocks_.count[block]; ++s)
      total[s].v = f_.data[start + s].v + received_[start + s].from[LEFT] +
                   received_[start + s].from[RIGHT] + received_[start + s].from[ABOVE] +
                   received_[start + s].from[BELOW];
  }

private:
  /// One plane only, and every point at most half as far from it as "no plane" allows.
  bool isSettled(std::size_t block) const
  {
    if (blocks_.count[block] != 2)
      return blocks_.count[block] < 2;
    for (int row = 0; row < SIDE; ++row) {
      const BlockRow* slots = &f_.data[f_.dataRow(block, row)];
      for (int k = 0; k < SIDE; ++k)
        if (2 * slots[1].v[k] > slots[0].v[k])
          return false;
    }
    return true;
  }

  /// For each block and each of its neighbours: where the neighbour finds its labels.
  void findSlotMaps()
  {
    const int dx[SIDES] = {-1, 1, 0, 0};
    const int dy[SIDES] = {0, 0, -1, 1};
    for (auto& maps : slot_of_)
      maps.resize(blocks_.count.size());
    for (int row = 0; row < blocks_.rows; ++row)
      for (int column = 0; column < blocks_.columns; ++column)
        for (int side = 0; side < SIDES; ++side) {
          const int other_column = column + dx[side];
          const int other_row = row + dy[side];
          if (other_column < 0 || other_column >= blocks_.columns || other_row < 0 ||
              other_row >= blocks_.rows)
            continue;
          const std::size_t from = blocks_.at(column, row);
          slot_of_[side][from] = slotMap(from, blocks_.at(other_column, other_row));
        }
  }

  SlotMap slotMap(std::size_t from, std::size_t to) const
  {
    SlotMap map;
    map.fill(ABSENT);
    for (std::size_t t = 0; t < blocks_.count[to]; ++t)
      for (std::size_t s = 0; s < blocks_.count[from]; ++s)
        if (blocks_.labelsOf(from)[s] == blocks_.labelsOf(to)[t])
          map[t] = static_cast<std::uint8_t>(s);
    return map;
  }

  /// Potts messages: what the sender knows but for what the receiver told it, less its
  /// least value, and never more than the price of a change.
  void messages(const Beliefs& total, std::size_t count, std::size_t start, Side to,
                const BlockRow& weight, Beliefs& out) const
  {
    BlockRow::Numbers smallest = total[0].v - received_[start].from[to];
    for (std::size_t s = 0; s < count; ++s) {
      out[s].v = total[s].v - received_[start + s].from[to];
      smallest = least(smallest, out[s].v);
    }
    for (std::size_t s = 0; s < count; ++s)
      out[s].v = least(out[s].v - smallest, weight.v);
  }

  void send(int column, int block_row, int row, Side next_row)
  {
    const std::size_t block = blocks_.at(column, block_row);
    const std::size_t count = blocks_.count[block];
    if (count < 2) // nothing to choose from
      return;
    const std::size_t start = f_.dataRow(block, row);
    const BlockRow& right = f_.right[CandidateField::weightRow(block, row)];
    BlockRow left; // the weight to the left is the left point's weight to the right
    left.v = shiftRight(
        right.v, column > 0
                     ? f_.right[CandidateField::weightRow(block - 1, row)].v[LAST]
                     : std::int16_t{0});

    // All messages from the same beliefs, before any of them is written: the row is its own
    // neighbour.
    Beliefs total;
    Beliefs rightward;
    Beliefs leftward;
    Beliefs onward;
    beliefs(block, row, total);
    messages(total, count, start, RIGHT, right, rightward);
    messages(total, count, start, LEFT, left, leftward);
    sendToRow(column, block_row, row, next_row, total, onward);

    for (std::size_t s = 0; s < count; ++s) {
      auto& from = received_[start + s].from;
      from[LEFT] = shiftRight(rightward[s].v, from[LEFT][0]);
      from[RIGHT] = shiftLeft(leftward[s].v, from[RIGHT][LAST]);
    }
    if (column + 1 < blocks_.columns)
      sendAcross(block, block + 1, row, RIGHT, right.v[LAST], rightward);
    if (column > 0)
      sendAcross(block, block - 1, row, LEFT, left.v[0], leftward);
  }

  /// The message of the outermost point of a row to the block beside it.
  void sendAcross(std::size_t block, std::size_t target, int row, Side to,
                  std::int16_t weight, const Beliefs& out)
  {
    const std::size_t from = to == RIGHT ? LAST : 0;
    const std::size_t start = f_.dataRow(target, row);
    const SlotMap& map = slot_of_[to][block];
    for (std::size_t t = 0; t < blocks_.count[target]; ++t)
      received_[start + t].from[to ^ 1][LAST - from] =
          map[t] == ABSENT ? weight : out[map[t]].v[from];
  }

  /// Messages to the row above or below, in this block or the next.
  void sendToRow(int column, int block_row, int row, Side to, const Beliefs& total,
                 Beliefs& out)
  {
    const int step = to == BELOW ? 1 : -1;
    const int y = block_row * SIDE + row + step;
    if (y < 0 || y >= f_.height)
      return;
    const std::size_t block = blocks_.at(column, block_row);
    const std::size_t target = blocks_.at(column, y / SIDE);
    const std::size_t upper = to == BELOW ? block : target;
    const int upper_row = to == BELOW ? row : y % SIDE;
    const BlockRow& weight = f_.down[CandidateField::weightRow(upper, upper_row)];
    messages(total, blocks_.count[block], f_.dataRow(block, row), to, weight, out);
    const std::size_t start = f_.dataRow(target, y % SIDE);
    const SlotMap& map = slot_of_[to][block];
    for (std::size_t t = 0; t < blocks_.count[target]; ++t)
      if (target == block)
        received_[start + t].from[to ^ 1] = out[t].v;
      else
        received_[start + t].from[to ^ 1] = map[t] == ABSENT ? weight.v : out[map[t]].v;
  }

  const CandidateField& f_;
  const CandidateBlocks& blocks_;
  std::vector<Messages> received_;
  std::vector<std::uint8_t> settled_;
  int passes_ = 0;
  std::vector<SlotMap> slot_of_[SIDES]; ///< sender's slot of each of the receiver's
};

} // namespace

std::vector<std::uint16_t> propagateBeliefs(const CandidateField& field,
                                            const OrganizedPoints& points, int passes)
{
  Passes propagation(field);
  for (int t = 0; t < passes; ++t) {
    propagation.run(true);
    propagation.run(false);
  }
  std::vector<std::uint16_t> labels(points.size(), 0);
  Beliefs total;
  for (int y = 0; y < field.height; ++y)
    for (int column = 0; column < field.blocks.columns; ++column) {
      const std::size_t block = field.blocks.at(column, y / SIDE);
      propagation.beliefs(block, y % SIDE, total);
      for (int k = 0; k < SIDE && column * SIDE + k < field.width; ++k) {
        const std::size_t i =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(field.width) +
            static_cast<std::size_t>(column * SIDE + k);
        if (points.valid[i] == 0)
          continue;
        std::size_t best = 0;
        for (std::size_t s = 1; s < field.blocks.count[block]; ++s)
          if (total[s].v[static_cast<std::size_t>(k)] <
              total[best].v[static_cast<std::size_t>(k)])
            best = s;
        labels[i] = field.blocks.labelsOf(block)[best];
      }
    }
  return labels;
}

} // namespace pcl_mrf_planes::adaptive
