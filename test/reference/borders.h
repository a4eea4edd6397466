// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <evaluation/label_image.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

/** Borders of label images by looking at all pairs of points. */
namespace pcl_mrf_planes::reference {

/** \brief Whether point (x, y) is next to one of another label, both scored. */
inline bool isBorder(const std::vector<std::uint16_t>& image,
                     const std::vector<std::uint16_t>& truth, int width, int height,
                     int x, int y)
{
  const auto at = [&](int px, int py) {
    return static_cast<std::size_t>(py * width + px);
  };
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const int nx = x + dx;
    const int ny = y + dy;
    if (nx < 0 || ny < 0 || nx >= width || ny >= height)
      continue;
    if (truth[at(x, y)] != evaluation::NOT_SCORED &&
        truth[at(nx, ny)] != evaluation::NOT_SCORED &&
        image[at(x, y)] != image[at(nx, ny)])
      return true;
  }
  return false;
}

/** \brief Share of the border points of \a from that have one of \a to at most
 * \a distance columns and rows away; NaN without any. */
inline double borderShare(const std::vector<std::uint16_t>& from,
                          const std::vector<std::uint16_t>& to,
                          const std::vector<std::uint16_t>& truth, int width,
                          int height, int distance)
{
  double found = 0.0;
  double points = 0.0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if (!isBorder(from, truth, width, height, x, y))
        continue;
      points += 1.0;
      bool near = false;
      for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u)
          near = near || (std::abs(u - x) <= distance && std::abs(v - y) <= distance &&
                          isBorder(to, truth, width, height, u, v));
      found += near ? 1.0 : 0.0;
    }
  return found / points; // 0 / 0 is NaN
}

} // namespace pcl_mrf_planes::reference
