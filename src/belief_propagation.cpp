// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/belief_propagation.h>

#include "belief_propagation_kernel.h"
#include "threads.h"

#include <algorithm>

namespace pcl_mrf_planes {

namespace {

constexpr int DIRECTIONS = 4;

/// The direction that a message has for its receiver: what went right comes from the
/// left.
constexpr int opposite(int direction)
{
  return direction ^ 1;
}

std::uint16_t leastPairwise(const GridField& field)
{
  std::uint16_t least = GridField::NO_EDGE;
  for (int a = 0; a < field.labels(); ++a)
    for (int b = 0; b < a; ++b)
      least = std::min(least, field.pairwise(a, b));
  return least;
}

} // namespace

BeliefPropagation::BeliefPropagation(const GridField& field, unsigned int threads)
: field_(field)
, threads_(threads)
{
  for (auto& direction : received_)
    for (auto& colour : direction)
      colour.assign(field.layout().bufferSize(field.labels()), 0);
}

namespace {

SiteRow siteRow(const GridField& field, const std::vector<std::uint16_t> received[4][2],
                int colour, int y)
{
  const CheckerboardLayout& layout = field.layout();
  SiteRow row{};
  row.sites = layout.sitesInRow(y, colour);
  row.labels = field.labels();
  row.label_stride = layout.stride;
  row.model = field.edgeModel();
  row.data = field.dataRow(colour, y, 0);
  for (int d = 0; d < DIRECTIONS; ++d)
    row.received[d] =
        received[d][colour].data() + layout.rowStart(y, field.labels(), 0);
  row.pairwise = field.pairwiseRow(0);
  row.scale = field.scaleRow(0);
  return row;
}

} // namespace

std::uint16_t BeliefPropagation::sendMessages(int colour)
{
  const CheckerboardLayout& layout = field_.layout();
  const int other = 1 - colour;
  const int labels = field_.labels();
  const std::uint16_t least = leastPairwise(field_);
  std::vector<std::uint16_t> change(static_cast<std::size_t>(layout.height), 0);

  parallelRows(layout.height, threads_, [&](int y) {
    SiteRow row = siteRow(field_, received_, colour, y);
    row.least_pairwise = least;
    // The neighbour to the left of site k is number k - 1 of the other colour where
    // this row starts at x = 0, and number k where it starts at x = 1.
    const int left = CheckerboardLayout::firstColumn(y, colour) - 1;
    const int right = left + 1;
    const auto target = [&](int direction, int target_y, int shift) {
      return received_[opposite(direction)][other].data() +
             layout.rowStart(target_y, labels, 0) + shift;
    };
    SendRow send{};
    send.target[FROM_LEFT] = target(FROM_LEFT, y, left);
    send.weight[FROM_LEFT] = field_.rightRow(other, y) + left;
    send.target[FROM_RIGHT] = target(FROM_RIGHT, y, right);
    send.weight[FROM_RIGHT] = field_.rightRow(colour, y);
    if (y > 0) {
      send.target[FROM_ABOVE] = target(FROM_ABOVE, y - 1, 0);
      send.weight[FROM_ABOVE] = field_.downRow(other, y - 1);
    }
    if (y + 1 < layout.height) {
      send.target[FROM_BELOW] = target(FROM_BELOW, y + 1, 0);
      send.weight[FROM_BELOW] = field_.downRow(colour, y);
    }
    change[static_cast<std::size_t>(y)] = sendRow(row, send);
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
  const auto width = static_cast<std::size_t>(layout.width);
  std::vector<std::uint16_t> labels(width * static_cast<std::size_t>(layout.height));
  parallelRows(layout.height, threads_, [&](int y) {
    std::vector<std::uint16_t> row_labels(static_cast<std::size_t>(layout.stride));
    for (int colour = 0; colour < 2; ++colour) {
      const SiteRow row = siteRow(field_, received_, colour, y);
      mapRow(row, row_labels.data());
      std::uint16_t* out = labels.data() + static_cast<std::size_t>(y) * width +
                           CheckerboardLayout::firstColumn(y, colour);
      for (int k = 0; k < row.sites; ++k)
        out[2 * k] = row_labels[static_cast<std::size_t>(k)];
    }
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
