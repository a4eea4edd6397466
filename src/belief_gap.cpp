// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/belief_gap.h>

#include <algorithm>

namespace pcl_mrf_planes {

namespace {

/// Data cost and the four messages; no sum of them exceeds 16 bits.
std::uint16_t belief(const GridField& field, const BeliefPropagation& propagation,
                     int x, int y, int label)
{
  unsigned int sum = field.data(x, y, label);
  for (const int direction :
       {BeliefPropagation::FROM_LEFT, BeliefPropagation::FROM_RIGHT,
        BeliefPropagation::FROM_ABOVE, BeliefPropagation::FROM_BELOW})
    sum += propagation.message(direction, x, y, label);
  return static_cast<std::uint16_t>(std::min(sum, 65535U));
}

} // namespace

std::vector<std::uint16_t> beliefGaps(const GridField& field,
                                      const BeliefPropagation& propagation)
{
  std::vector<std::uint16_t> gaps;
  gaps.reserve(static_cast<std::size_t>(field.width()) *
               static_cast<std::size_t>(field.height()));
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x) {
      std::uint16_t best = belief(field, propagation, x, y, 0);
      std::uint16_t second = 65535;
      for (int label = 1; label < field.labels(); ++label) {
        const std::uint16_t cost = belief(field, propagation, x, y, label);
        second = std::min(second, std::max(best, cost));
        best = std::min(best, cost);
      }
      gaps.push_back(field.labels() > 1 ? static_cast<std::uint16_t>(second - best)
                                        : second);
    }
  return gaps;
}

} // namespace pcl_mrf_planes
