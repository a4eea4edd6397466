// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/belief_propagation.h>

#include "belief_propagation_kernel.h"
#include "threads.h"

#include <algorithm>

namespace pcl_mrf_planes {

static_assert(BeliefPropagation::FROM_LEFT == LEFT &&
                  BeliefPropagation::FROM_RIGHT == RIGHT &&
                  BeliefPropagation::FROM_ABOVE == ABOVE &&
                  BeliefPropagation::FROM_BELOW == BELOW,
              "the kernel numbers directions as the class does");

namespace {

SiteRow siteRow(const GridField& field, const std::vector<std::uint16_t> received[4][2],
                const PriceTable& table, int colour, int y)
{
  const CheckerboardLayout& layout = field.layout();
  SiteRow row = makeSiteRow(layout, field.prices(), table, colour, y);
  row.data = field.dataRow(colour, y, 0);
  for (int d = 0; d < DIRECTIONS; ++d)
    row.received[d] = received[d][colour].data() + layout.rowStart(y, row.labels);
  return row;
}

} // namespace

BeliefPropagation::BeliefPropagation(const GridField& field, unsigned int threads)
: field_(field)
, threads_(threads)
{
  for (auto& direction : received_)
    for (auto& colour : direction)
      colour.assign(field.layout().bufferSize(field.height(), field.labels()), 0);
}

std::uint16_t BeliefPropagation::sendMessages(int colour)
{
  const CheckerboardLayout& layout = field_.layout();
  const int other = 1 - colour;
  const auto received = [&](int direction, int y) {
    return received_[direction][other].data() + layout.rowStart(y, field_.labels());
  };
  std::vector<std::uint16_t> change(static_cast<std::size_t>(layout.height), 0);
  const PriceTable table(field_.prices());
  const ThreadTeam team(threads_);
  parallelRows(layout.height, threads_, [&](int y) {
    SendRow rows;
    rows.target[LEFT] = received(RIGHT, y);
    rows.weight[LEFT] = field_.rightRow(other, y);
    rows.target[RIGHT] = received(LEFT, y);
    rows.weight[RIGHT] = field_.rightRow(colour, y);
    if (y > 0) {
      rows.target[ABOVE] = received(BELOW, y - 1);
      rows.weight[ABOVE] = field_.downRow(other, y - 1);
    }
    if (y + 1 < layout.height) {
      rows.target[BELOW] = received(ABOVE, y + 1);
      rows.weight[BELOW] = field_.downRow(colour, y);
    }
    alignToSenders(rows, colour, y);
    KernelScratch scratch(field_.labels(), layout.stride);
    change[static_cast<std::size_t>(y)] =
        sendWatchedRow(siteRow(field_, received_, table, colour, y), rows, scratch);
  });
  return change.empty() ? std::uint16_t{0}
                        : *std::max_element(change.begin(), change.end());
}

int BeliefPropagation::iterate(int iterations, int tolerance)
{
  for (int i = 0; i < iterations; ++i) {
    if (settled(tolerance))
      return i;
    const int colour = done_ & 1;
    change_[colour] = sendMessages(colour);
    ++done_;
  }
  return iterations;
}

std::vector<std::uint16_t> BeliefPropagation::mapLabels() const
{
  const CheckerboardLayout& layout = field_.layout();
  std::vector<std::uint16_t> labels(static_cast<std::size_t>(layout.width) *
                                    static_cast<std::size_t>(layout.height));
  const PriceTable table(field_.prices());
  const ThreadTeam team(threads_);
  parallelRows(layout.height, threads_, [&](int y) {
    KernelScratch scratch(field_.labels(), layout.stride);
    for (int colour = 0; colour < 2; ++colour)
      mapSites(siteRow(field_, received_, table, colour, y), layout.width, colour, y,
               scratch, labels);
  });
  return labels;
}

std::uint16_t BeliefPropagation::message(int direction, int x, int y, int l) const
{
  const CheckerboardLayout& layout = field_.layout();
  return received_[direction][(x + y) & 1][layout.rowStart(y, field_.labels(), l) +
                                           static_cast<std::size_t>(x / 2)];
}

} // namespace pcl_mrf_planes
