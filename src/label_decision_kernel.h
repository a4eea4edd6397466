// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "belief_propagation_kernel.h"
#include "frame_memory.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// A row of sites whose last messages are still to come, and its neighbours, which would
/// send them. Only EdgeModel::SOFT_THRESHOLD.
struct UndecidedRow {
  SiteRow row; ///< the sites themselves; what they received is not read
  /// By direction: the neighbours, each in line with its site; no data: there are none.
  SiteRow neighbour[DIRECTIONS];
  const std::uint16_t* weight[DIRECTIONS] = {}; ///< of the edges to them
  const std::uint16_t* cheapest =
      nullptr; ///< for each label, to any other: cheapestPairs()
};

/// Least price of each label beside any other one, for edges of weight 0; NO_EDGE for a
/// single label.
FrameVector<std::uint16_t> cheapestPairs(const PairPrices& prices);

/// Shifts the neighbours to the left and right so that each lines up with its site.
void alignToReceivers(UndecidedRow& undecided, int colour, int y);

/// Working memory of decideSites(), for one thread.
class DecisionScratch {
public:
  DecisionScratch(int labels, int layout_stride);

  /// By how much each label is worse for a neighbour than its best: a vector for each label.
  std::uint16_t* excess[DIRECTIONS];
  std::uint16_t* low;             ///< bound of the belief: a vector for each label
  std::uint16_t* high;            ///< bound of the belief: a vector for each label
  std::uint16_t* where;           ///< a vector for each open label
  FrameVector<int> open;          ///< labels
  FrameVector<int> active;        ///< labels
  FrameVector<std::uint16_t> row; ///< a row of labels

private:
  FrameVector<std::uint16_t> buffer_;
};

/** \brief Writes the labels that the sites of the row would have after the last messages,
 * without sending these.
 *
 * Of the last messages nothing but the smallest belief counts, so most of them need not be
 * known: a message lies between what its sender could be talked into by the nearest other
 * label and what it knows by itself. Only labels that can still win between these bounds
 * are worked out. The same labels as sendRow() and mapSites() give, bit for bit.
 */
void decideSites(const UndecidedRow& undecided, int width, int colour, int y,
                 DecisionScratch& scratch, std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes
