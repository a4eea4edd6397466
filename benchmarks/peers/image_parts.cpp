// SPDX-License-Identifier: BSD-3-Clause
#include "image_parts.h"

namespace pcl_mrf_planes::benchmarks {

namespace {

/// Moves the part around a point out of the mask.
std::vector<std::size_t> takePart(std::vector<std::uint8_t>& mask, std::size_t width,
                                  std::size_t start)
{
  std::vector<std::size_t> part = {start};
  mask[start] = 0;
  const auto visit = [&](std::size_t i) {
    if (mask[i] == 0)
      return;
    mask[i] = 0;
    part.push_back(i);
  };
  for (std::size_t next = 0; next < part.size(); ++next) {
    const std::size_t i = part[next], column = i % width;
    if (column > 0)
      visit(i - 1);
    if (column + 1 < width)
      visit(i + 1);
    if (i >= width)
      visit(i - width);
    if (i + width < mask.size())
      visit(i + width);
  }
  return part;
}

} // namespace

std::vector<std::vector<std::size_t>>
connectedParts(const std::vector<std::uint8_t>& mask, std::size_t width,
               std::size_t min_points)
{
  std::vector<std::uint8_t> rest = mask;
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t i = 0; i < rest.size(); ++i)
    if (rest[i] != 0) {
      std::vector<std::size_t> part = takePart(rest, width, i);
      if (part.size() >= min_points)
        parts.push_back(std::move(part));
    }
  return parts;
}

} // namespace pcl_mrf_planes::benchmarks
