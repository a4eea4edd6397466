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

GridField::GridField(const CheckerboardLayout& layout, const PairPrices& prices)
: layout_(layout)
, prices_(prices)
{
  for (int colour = 0; colour < 2; ++colour) {
    data_[colour].assign(layout_.bufferSize(height(), labels()), 0);
    right_[colour].assign(layout_.bufferSize(height()), NO_EDGE);
    down_[colour].assign(layout_.bufferSize(height()), NO_EDGE);
  }
}

GridField::GridField(const FieldRows& rows)
: GridField(rows.layout(), rows.prices())
{
  for (int y = 0; y < height(); ++y) {
    FieldRow row{};
    for (int colour = 0; colour < 2; ++colour) {
      row.data[colour] = data_[colour].data() + layout_.rowStart(y, labels());
      row.right[colour] = right_[colour].data() + layout_.rowStart(y);
      row.down[colour] = down_[colour].data() + layout_.rowStart(y);
    }
    rows.fillRow(y, row);
  }
}

void GridField::fillRow(int y, const FieldRow& row) const
{
  for (int colour = 0; colour < 2; ++colour) {
    const int sites = layout_.sitesInRow(y, colour);
    for (int l = 0; l < labels(); ++l)
      std::copy_n(dataRow(colour, y, l), sites,
                  row.data[colour] + static_cast<std::ptrdiff_t>(l) * layout_.stride);
    std::copy_n(rightRow(colour, y), sites, row.right[colour]);
    std::copy_n(downRow(colour, y), sites, row.down[colour]);
  }
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
