// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"

#include <pcl_mrf_planes/field_rows.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// Directions of a neighbour; a message that goes one way comes from the opposite one.
enum Direction { LEFT, RIGHT, ABOVE, BELOW, DIRECTIONS };
constexpr int opposite(int direction)
{
  return direction ^ 1;
}

/// The prices of pairs as the message kernels read them.
class PriceTable {
public:
  explicit PriceTable(const PairPrices& prices);

  /// L x L, each price in both halves of its 32 bits. On the diagonal stands the least one
  /// of any two labels: a label by way of itself is never better than without.
  const std::uint32_t* twice() const { return twice_.data(); }
  /// Least cost of two different labels; NO_EDGE for a single label.
  std::uint16_t least() const { return least_; }

private:
  FrameVector<std::uint32_t> twice_;
  std::uint16_t least_;
};

/// One row of sites of one colour, as the message kernels see it. A row pointer leads
/// to label 0; label l is l * label_stride elements further on.
struct SiteRow {
  int sites = 0;        ///< sites of this colour in the row
  int labels = 0;       ///< L
  int label_stride = 0; ///< elements from a label's row to the next label's
  EdgeModel model = EdgeModel::SOFT_THRESHOLD;
  const std::uint16_t* pairwise = nullptr;     ///< L x L
  const std::uint32_t* prices_twice = nullptr; ///< L x L: PriceTable::twice()
  const std::uint16_t* scale = nullptr;        ///< L x L
  std::uint16_t least_pairwise = 0;            ///< least cost of two different labels
  const std::uint16_t* data = nullptr;
  /// By the sender's direction; none, of all directions, where no message has come yet.
  const std::uint16_t* received[DIRECTIONS] = {};

  bool hasHeard() const { return received[LEFT] != nullptr; }
};

/// Where the messages of a row go, for each direction: the row that receives them
/// (nullptr: there is none) and the weights of the edges.
struct SendRow {
  std::uint16_t* target[DIRECTIONS] = {};
  const std::uint16_t* weight[DIRECTIONS] = {};
};

/// Working memory of the kernels, for one thread.
struct KernelScratch {
  explicit KernelScratch(int labels, int layout_stride);

  std::uint16_t* h;       ///< a vector for each label and direction
  std::uint16_t* message; ///< a vector for each label
  FrameVector<int> active;
  FrameVector<std::uint16_t> row; ///< a row of labels

private:
  FrameVector<std::uint16_t> buffer_;
};

/// The parts of a SiteRow that do not depend on where its messages are kept.
SiteRow makeSiteRow(const CheckerboardLayout& layout, const PairPrices& prices,
                    const PriceTable& table, int colour, int y);

/// Shifts rows of the other colour so that each element lines up with its sender.
/// Before, weight[LEFT] holds the right edges of the other colour's sites of the same
/// row.
void alignToSenders(SendRow& send, int colour, int y);

/// Sends the messages of one row of sites.
void sendRow(const SiteRow& row, const SendRow& send, KernelScratch& scratch);

/// The same; returns the largest change of a message.
std::uint16_t sendWatchedRow(const SiteRow& row, const SendRow& send,
                             KernelScratch& scratch);

/// Writes the label of least belief cost of every site of the row into the label image.
void mapSites(const SiteRow& row, int width, int colour, int y, KernelScratch& scratch,
              std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes
