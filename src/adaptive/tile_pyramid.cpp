// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/tile_pyramid.h"
#include "adaptive/tile_sums_kernel.h"

#include <algorithm>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Ten sums of the points of a tile that the image's right border cuts.
TileSums sumCutTile(const OrganizedPoints& points, int u0, int v0)
{
  TileSums s;
  const int v1 = std::min(points.height, v0 + CELL);
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < points.width; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(points.width) +
          static_cast<std::size_t>(u);
      if (points.valid[i])
        s.add(points.x[i], points.y[i], points.z[i]);
    }
  return s;
}

void sumCells(const OrganizedPoints& points, TileLevel& cells)
{
  const auto width = static_cast<std::size_t>(points.width);
  const int whole = points.width / CELL;
  for (int r = 0; r < cells.rows; ++r) {
    const std::size_t i = static_cast<std::size_t>(r * CELL) * width;
    const TileStrip strip = {&points.x[i], &points.y[i],
                             &points.z[i], &points.valid[i],
                             width,        std::min(CELL, points.height - r * CELL)};
    sumTiles(strip, static_cast<std::size_t>(whole), &cells.sums[cells.at(0, r)]);
    if (whole < cells.columns)
      cells.sums[cells.at(whole, r)] = sumCutTile(points, whole * CELL, r * CELL);
  }
}

void poolTiles(const TileLevel& below, TileLevel& level)
{
  for (int r = 0; r < level.rows; ++r)
    for (int c = 0; c < level.columns; ++c) {
      TileSums& s = level.sums[level.at(c, r)];
      for (int j = 2 * r; j < std::min(2 * r + 2, below.rows); ++j)
        for (int i = 2 * c; i < std::min(2 * c + 2, below.columns); ++i)
          s += below.sums[below.at(i, j)];
    }
}

} // namespace

bool isFilled(const TileLevel& level, std::size_t tile,
              const AdaptiveParameters& parameters)
{
  return level.sums[tile].n >= parameters.min_fill * level.side * level.side;
}

std::vector<TileLevel> buildTilePyramid(const OrganizedPoints& points,
                                        const AdaptiveParameters& parameters)
{
  std::vector<TileLevel> pyramid(static_cast<std::size_t>(parameters.levels));
  for (std::size_t l = 0; l < pyramid.size(); ++l) {
    TileLevel& level = pyramid[l];
    level.side = CELL << l;
    level.columns = (points.width + level.side - 1) / level.side;
    level.rows = (points.height + level.side - 1) / level.side;
    level.sums.resize(level.at(0, level.rows));
    if (l == 0) {
      sumCells(points, level);
      continue;
    }
    poolTiles(pyramid[l - 1], level);
    level.planes.resize(level.sums.size());
    fitPlanes(level.sums.data(), level.sums.size(), level.planes.data());
    for (std::size_t i = 0; i < level.sums.size(); ++i)
      if (!isFilled(level, i, parameters))
        level.planes[i] = FittedPlane();
  }
  return pyramid;
}

} // namespace pcl_mrf_planes::adaptive
