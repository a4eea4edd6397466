// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/active_strips.h"
#include "adaptive/candidate_field.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr std::size_t SIDE = CandidateBlocks::SIDE;
constexpr std::size_t LAST = SIDE - 1;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
constexpr std::uint8_t ABSENT = 255; ///< the neighbour has no such label
constexpr std::size_t SETTLED = CandidateField::SETTLED;

enum Side : std::size_t { LEFT, RIGHT, ABOVE, BELOW, SIDES };
static_assert(SIDES == ActiveBlock::SIDES);

static_assert(sizeof(Messages::from) == SIDES * sizeof(BlockRow::Numbers),
              "a message from each side");

constexpr Side opposite(Side side)
{
  return static_cast<Side>(side ^ 1U);
}

using Numbers = BlockRow::Numbers;
using Beliefs = std::array<Numbers, SLOTS>; // not initialized: most are not in use
using SlotMap = ActiveBlock::SlotMap;

/// The eight numbers as two words, the first number lowest: what moves from word to word is
/// one shift away, without an instruction that only newer machines have.
using Words __attribute__((vector_size(16))) = std::uint64_t;
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "the first number is the lowest");
constexpr int NUMBER = 16; ///< bits
constexpr int REST = 48;

/// Every number moves to the right by one.
Numbers shiftRight(Numbers v, std::int16_t first)
{
  const Words words = reinterpret_cast<Words>(v);
  const Words carry = words >> REST;
  const Words in = {static_cast<std::uint16_t>(first), carry[0]};
  return reinterpret_cast<Numbers>((words << NUMBER) | in);
}

/// Every number moves to the left by one.
Numbers shiftLeft(Numbers v, std::int16_t last)
{
  const Words words = reinterpret_cast<Words>(v);
  const Words carry = words << REST;
  const Words in = {
      carry[1], static_cast<std::uint64_t>(static_cast<std::uint16_t>(last)) << REST};
  return reinterpret_cast<Numbers>((words >> NUMBER) | in);
}

/// Passes over the image, with the messages that every point has received.
class Passes {
public:
  Passes(const CandidateField& field, unsigned int threads, BeliefMemory& memory)
  : f_(field)
  , threads_(threads)
  , blocks_(field.blocks)
  , received_(memory.received)
  , places_(memory.places)
  , strips_(field, threadCount(threads))
  {
    received_.resize(field.data.size());
    places_.resize(field.active.size());
    parallelRows(blocks_.rows, threads, [&](int row) {
      for (std::size_t a = strips_.first(row, 0); a < strips_.first(row + 1, 0); ++a) {
        std::fill_n(received_.begin() + static_cast<std::ptrdiff_t>(field.first[a]),
                    SIDE * blocks_.count[field.active[a]], Messages());
        settleIn(a, row);
      }
    });
  }

  /// One pass: messages within each row, and on to the next row.
  void run(bool downwards)
  {
    staggeredSteps(strips_.count(), f_.height, threads_, [&](int strip, int step) {
      const int y = downwards ? step : f_.height - 1 - step;
      const int row = y / static_cast<int>(SIDE);
      for (std::size_t a = strips_.first(row, strip); a < strips_.first(row, strip + 1);
           ++a)
        sendFrom(a, static_cast<std::size_t>(y) % SIDE, downwards ? BELOW : ABOVE);
    });
  }

  /// Data costs plus all messages of a row of an active block.
  template <class Count>
  void beliefs(std::size_t start, Count count, Beliefs& total) const
  {
    std::size_t s = 0;
    do { // an active block has a label, as the compiler cannot know
      const Messages& m = received_[start + s];
      total[s] = f_.data[start + s].v + (m.from[LEFT] + m.from[RIGHT]) +
                 (m.from[ABOVE] + m.from[BELOW]);
    } while (++s < count);
  }

private:
  /// Finds the neighbours of a block, and what the settled ones among them say.
  void settleIn(std::size_t a, int row)
  {
    const std::size_t block = f_.active[a];
    const int column =
        static_cast<int>(block % static_cast<std::size_t>(blocks_.columns));
    ActiveBlock& place = places_[a];
    place.count = blocks_.count[block];
    place.first = f_.first[a];
    const int dx[SIDES] = {-1, 1, 0, 0};
    const int dy[SIDES] = {0, 0, -1, 1};
    for (const Side side : {LEFT, RIGHT, ABOVE, BELOW}) {
      place.neighbour[side] = SETTLED;
      const int c = column + dx[side];
      const int r = row + dy[side];
      if (c < 0 || c >= blocks_.columns || r < 0 || r >= blocks_.rows)
        continue;
      const std::size_t other = blocks_.at(c, r);
      place.neighbour[side] = f_.number[other];
      if (f_.number[other] == SETTLED)
        hear(place, f_.weight[a], block, side, blocks_.labelsOf(other)[0]);
      else
        place.slot[side] = slotMap(block, other);
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

  /// The messages of a settled neighbour: any label but its own costs a change.
  void hear(const ActiveBlock& place, const BlockWeights& weight, std::size_t block,
            Side side, std::uint16_t label)
  {
    for (std::size_t s = 0; s < place.count; ++s) {
      if (blocks_.labelsOf(block)[s] == label)
        continue;
      if (side == ABOVE)
        received_[place.first + s].from[ABOVE] = weight.above.v;
      else if (side == BELOW)
        received_[place.first + LAST * place.count + s].from[BELOW] =
            weight.down[LAST].v;
      else
        for (std::size_t r = 0; r < SIDE; ++r)
          received_[place.first + r * place.count + s]
              .from[side][side == LEFT ? 0 : LAST] =
              side == LEFT ? weight.left.v[r] : weight.right[r].v[LAST];
    }
  }

  /// Potts messages: what the sender knows but for what the receiver told it, less its
  /// least value, and never more than the price of a change.
  template <class Count>
  void messages(const Beliefs& total, Count count, std::size_t start, Side to,
                Numbers weight, Beliefs& out) const
  {
    Numbers smallest = total[0] - received_[start].from[to];
    out[0] = smallest;
    for (std::size_t s = 1; s < count; ++s) {
      out[s] = total[s] - received_[start + s].from[to];
      smallest = least(smallest, out[s]);
    }
    for (std::size_t s = 0; s < count; ++s)
      out[s] = least(out[s] - smallest, weight);
  }

  /// Few labels are the rule: their loops are unrolled.
  void sendFrom(std::size_t a, std::size_t row, Side next_row)
  {
    const std::size_t count = places_[a].count;
    if (count == 2)
      send(a, row, next_row, std::integral_constant<std::size_t, 2>());
    else if (count == 3)
      send(a, row, next_row, std::integral_constant<std::size_t, 3>());
    else
      send(a, row, next_row, count);
  }

  template <class Count>
  void send(std::size_t a, std::size_t row, Side next_row, Count count)
  {
    const ActiveBlock& place = places_[a];
    const std::size_t start = place.first + row * count;
    const BlockWeights& weight = f_.weight[a];
    const Numbers right = weight.right[row].v;
    const Numbers left = shiftRight(right, weight.left.v[row]);

    // All messages from the same beliefs, before any of them is written: the row is its own
    // neighbour.
    Beliefs total;
    Beliefs rightward;
    Beliefs leftward;
    beliefs(start, count, total);
    messages(total, count, start, RIGHT, right, rightward);
    messages(total, count, start, LEFT, left, leftward);
    sendToRow(place, weight, row, next_row, total, count);

    for (std::size_t s = 0; s < count; ++s) {
      auto& from = received_[start + s].from;
      from[LEFT] = shiftRight(rightward[s], from[LEFT][0]);
      from[RIGHT] = shiftLeft(leftward[s], from[RIGHT][LAST]);
    }
    sendAcross(place, row, RIGHT, right[LAST], rightward);
    sendAcross(place, row, LEFT, left[0], leftward);
  }

  /// The message of the outermost point of a row to the block beside it.
  void sendAcross(const ActiveBlock& place, std::size_t row, Side to,
                  std::int16_t weight, const Beliefs& out)
  {
    if (place.neighbour[to] == SETTLED)
      return;
    const ActiveBlock& target = places_[place.neighbour[to]];
    const std::size_t from = to == RIGHT ? LAST : 0;
    const std::size_t start = target.first + row * target.count;
    const SlotMap& map = place.slot[to];
    for (std::size_t t = 0; t < target.count; ++t)
      received_[start + t].from[opposite(to)][LAST - from] =
          map[t] == ABSENT ? weight : out[map[t]][from];
  }

  /// Messages to the row above or below, in this block or the next.
  template <class Count>
  void sendToRow(const ActiveBlock& place, const BlockWeights& weight, std::size_t row,
                 Side to, const Beliefs& total, Count count)
  {
    Beliefs out;
    const std::size_t start = place.first + row * count;
    const bool leaves = row == (to == BELOW ? LAST : 0);
    if (!leaves) {
      const std::size_t next = to == BELOW ? row + 1 : row - 1;
      messages(total, count, start, to, weight.down[std::min(row, next)].v, out);
      for (std::size_t s = 0; s < count; ++s)
        received_[place.first + next * count + s].from[opposite(to)] = out[s];
      return;
    }
    if (place.neighbour[to] == SETTLED)
      return;
    const Numbers price = to == BELOW ? weight.down[LAST].v : weight.above.v;
    messages(total, count, start, to, price, out);
    const ActiveBlock& target = places_[place.neighbour[to]];
    const std::size_t next = target.first + (LAST - row) * target.count;
    const SlotMap& map = place.slot[to];
    for (std::size_t t = 0; t < target.count; ++t)
      received_[next + t].from[opposite(to)] = map[t] == ABSENT ? price : out[map[t]];
  }

  const CandidateField& f_;
  unsigned int threads_;
  const CandidateBlocks& blocks_;
  std::vector<Messages>& received_;
  std::vector<ActiveBlock>& places_;
  ActiveStrips strips_;
};

/// Labels of a row of an active block: those of the least beliefs.
Numbers leastLabels(const Beliefs& total, std::size_t count,
                    const std::uint16_t* labels)
{
  Numbers best = total[0];
  Numbers label = static_cast<std::int16_t>(labels[0]) + Numbers{};
  for (std::size_t s = 1; s < count; ++s) {
    const Numbers better = total[s] < best;
    const Numbers other = static_cast<std::int16_t>(labels[s]) + Numbers{};
    best = least(best, total[s]);
    label = (better & other) | (~better & label);
  }
  return label;
}

/// Writes labels block by block, neighbours of one settled label together.
class LabelWriter {
public:
  /// \param labels of all points, to be written
  LabelWriter(const CandidateField& field, const OrganizedPoints& points,
              const Passes& propagation, std::vector<std::uint16_t>& labels)
  : labels_(labels)
  , f_(field)
  , points_(points)
  , propagation_(propagation)
  , width_(static_cast<std::size_t>(field.width))
  {}

  /// The labels of a row of blocks.
  void writeRow(int row)
  {
    for (int column = 0; column < f_.blocks.columns;) {
      if (const std::size_t block = f_.blocks.at(column, row); isActive(block)) {
        writeActive(block, column, row);
        ++column;
        continue;
      }
      const int end = endOfSettled(column, row);
      writeSettled(column, end, row);
      column = end;
    }
  }

private:
  bool isActive(std::size_t block) const { return f_.number[block] != SETTLED; }

  /// The first block of a row of them that has not the settled label of the first one.
  int endOfSettled(int column, int row) const
  {
    const std::uint16_t label = f_.blocks.labelsOf(f_.blocks.at(column, row))[0];
    while (++column < f_.blocks.columns) {
      const std::size_t block = f_.blocks.at(column, row);
      if (isActive(block) || f_.blocks.labelsOf(block)[0] != label)
        break;
    }
    return column;
  }

  void writeSettled(int column, int end, int row)
  {
    const std::uint16_t label = f_.blocks.labelsOf(f_.blocks.at(column, row))[0];
    const std::size_t first = static_cast<std::size_t>(column) * SIDE;
    const std::size_t last = std::min(static_cast<std::size_t>(end) * SIDE, width_);
    for (std::size_t y = top(row); y < bottom(row); ++y) {
      const std::uint8_t* valid = &points_.valid[y * width_];
      std::uint16_t* out = &labels_[y * width_];
      for (std::size_t x = first; x < last; ++x)
        out[x] = static_cast<std::uint16_t>(label * valid[x]);
    }
  }

  void writeActive(std::size_t block, int column, int row)
  {
    const std::size_t count = f_.blocks.count[block];
    const std::uint16_t* names = f_.blocks.labelsOf(block);
    const std::size_t first = static_cast<std::size_t>(column) * SIDE;
    const std::size_t columns = std::min(SIDE, width_ - first);
    Beliefs total;
    std::uint16_t label[SIDE];
    for (std::size_t y = top(row); y < bottom(row); ++y) {
      propagation_.beliefs(f_.dataRow(f_.number[block], y % SIDE), count, total);
      const Numbers best = leastLabels(total, count, names);
      std::memcpy(label, &best, sizeof(label));
      const std::size_t i = y * width_ + first;
      for (std::size_t k = 0; k < columns; ++k)
        labels_[i + k] = static_cast<std::uint16_t>(label[k] * points_.valid[i + k]);
    }
  }

  static std::size_t top(int row) { return static_cast<std::size_t>(row) * SIDE; }
  std::size_t bottom(int row) const
  {
    return std::min(top(row) + SIDE, static_cast<std::size_t>(f_.height));
  }

  std::vector<std::uint16_t>& labels_;
  const CandidateField& f_;
  const OrganizedPoints& points_;
  const Passes& propagation_;
  std::size_t width_;
};

} // namespace

std::vector<std::uint16_t> propagateBeliefs(const CandidateField& field,
                                            const OrganizedPoints& points, int passes,
                                            unsigned int threads)
{
  BeliefMemory memory;
  std::vector<std::uint16_t> labels;
  propagateBeliefs(field, points, passes, threads, memory, labels);
  return labels;
}

void propagateBeliefs(const CandidateField& field, const OrganizedPoints& points,
                      int passes, unsigned int threads, BeliefMemory& memory,
                      std::vector<std::uint16_t>& labels)
{
  Passes propagation(field, threads, memory);
  for (int t = 0; t < passes; ++t)
    for (const bool downwards : {true, false})
      propagation.run(downwards);
  labels.resize(points.size());
  LabelWriter writer(field, points, propagation, labels);
  parallelRows(field.blocks.rows, threads, [&](int row) { writer.writeRow(row); });
}

} // namespace pcl_mrf_planes::adaptive
