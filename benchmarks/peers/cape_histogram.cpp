// SPDX-License-Identifier: BSD-3-Clause
#include "cape.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::benchmarks::cape {

namespace {

/// The bin of a direction: angle from the line of sight, and angle about it, which has
/// no meaning in the first bin of the other.
int binOf(const Eigen::Vector3d& normal, int bins)
{
  const double tilt = std::acos(std::clamp(-normal.z(), -1.0, 1.0)) / M_PI;
  const double turn = (std::atan2(normal.x(), normal.y()) + M_PI) / (2.0 * M_PI);
  const int row = static_cast<int>(tilt * (bins - 1));
  const int column = row > 0 ? static_cast<int>(turn * (bins - 1)) : 0;
  return row * bins + column;
}

} // namespace

NormalHistogram::NormalHistogram(const std::vector<Cell>& cells, int bins)
: bin_(cells.size(), -1)
, count_(static_cast<std::size_t>(bins * bins), 0)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (cells[k].is_planar) {
      bin_[k] = binOf(cells[k].patch.normal, bins);
      ++count_[static_cast<std::size_t>(bin_[k])];
    }
}

std::vector<int> NormalHistogram::fullestBin() const
{
  const auto fullest = std::max_element(count_.begin(), count_.end());
  const int bin = static_cast<int>(fullest - count_.begin());
  std::vector<int> cells;
  cells.reserve(static_cast<std::size_t>(*fullest));
  for (std::size_t k = 0; k < bin_.size(); ++k)
    if (bin_[k] == bin)
      cells.push_back(static_cast<int>(k));
  return cells;
}

void NormalHistogram::remove(int cell)
{
  int& bin = bin_[static_cast<std::size_t>(cell)];
  --count_[static_cast<std::size_t>(bin)];
  bin = -1;
}

} // namespace pcl_mrf_planes::benchmarks::cape
