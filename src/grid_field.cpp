// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/grid_field.h>

#include <algorithm>

namespace pcl_mrf_planes {

CheckerboardLayout::CheckerboardLayout(int grid_width, int grid_height)
: width(grid_width)
, height(grid_height)
{
  const int sites = (grid_width + 1) / 2;
  // A vector of up to PADDING elements may start at the last site and be stored one
  // element further on; the next row's leading padding is never reached.
  stride = PADDING + (sites + PADDING - 1) / PADDING * PADDING + PADDING;
}

GridField::GridField(int width, int height, int labels, EdgeModel model)
: layout_(width, height)
, labels_(labels)
, model_(model)
{
  const std::size_t pairs =
      static_cast<std::size_t>(labels) * static_cast<std::size_t>(labels);
  for (int colour = 0; colour < 2; ++colour) {
    data_[colour].assign(layout_.bufferSize(labels), 0);
    right_[colour].assign(layout_.bufferSize(), NO_EDGE);
    down_[colour].assign(layout_.bufferSize(), NO_EDGE);
  }
  pairwise_.assign(pairs, 0);
  scale_.assign(pairs, 0);
}

std::uint32_t GridField::price(int a, int b, std::uint16_t weight) const
{
  if (weight == NO_EDGE)
    return 0;
  const std::uint32_t cost = pairwise(a, b);
  if (model_ == EdgeModel::SOFT_THRESHOLD)
    return cost > weight ? cost - weight : 0;
  const std::uint32_t scaled = (static_cast<std::uint32_t>(scale(a, b)) * weight) >> 16;
  return std::max(cost, scaled);
}

std::uint64_t GridField::energy(const std::vector<std::uint16_t>& labelling) const
{
  std::uint64_t total = 0;
  std::size_t i = 0;
  const auto row = static_cast<std::size_t>(width());
  for (int y = 0; y < height(); ++y)
    for (int x = 0; x < width(); ++x, ++i) {
      total += data(x, y, labelling[i]);
      if (x + 1 < width())
        total += price(labelling[i], labelling[i + 1], rightEdge(x, y));
      if (y + 1 < height())
        total += price(labelling[i], labelling[i + row], downEdge(x, y));
    }
  return total;
}

} // namespace pcl_mrf_planes
