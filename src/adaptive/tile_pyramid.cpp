// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/tile_pyramid.h"
#include "adaptive/tile_sums_kernel.h"
#include "threads.h"

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

void sumCells(const OrganizedPoints& points, TileRows rows, TileLevel& cells)
{
  const auto width = static_cast<std::size_t>(points.width);
  const int whole = points.width / CELL;
  for (int r = rows.begin; r < rows.end; ++r) {
    const std::size_t i = static_cast<std::size_t>(r * CELL) * width;
    const TileStrip strip = {&points.x[i], &points.y[i],
                             &points.z[i], &points.valid[i],
                             width,        std::min(CELL, points.height - r * CELL)};
    sumTiles(strip, static_cast<std::size_t>(whole), &cells.sums[cells.at(0, r)]);
    if (whole < cells.columns)
      cells.sums[cells.at(whole, r)] = sumCutTile(points, whole * CELL, r * CELL);
  }
}

void poolTiles(const TileLevel& below, TileRows rows, TileLevel& level)
{
  for (int r = rows.begin; r < rows.end; ++r)
    for (int c = 0; c < level.columns; ++c) {
      TileSums s;
      for (int j = 2 * r; j < std::min(2 * r + 2, below.rows); ++j)
        for (int i = 2 * c; i < std::min(2 * c + 2, below.columns); ++i)
          s += below.sums[below.at(i, j)];
      level.sums[level.at(c, r)] = s;
    }
}

void fitTiles(TileRows rows, const AdaptiveParameters& parameters, TileLevel& level)
{
  const std::size_t first = level.at(0, rows.begin);
  const std::size_t last = level.at(0, rows.end);
  fitPlanes(&level.sums[first], last - first, &level.planes[first]);
  for (std::size_t i = first; i < last; ++i)
    if (!isFilled(level, i, parameters))
      level.planes[i] = FittedPlane();
}

void makeTiles(const TileLevel& below, TileRows rows,
               const AdaptiveParameters& parameters, TileLevel& level)
{
  poolTiles(below, rows, level);
  fitTiles(rows, parameters, level);
}

} // namespace

std::vector<TileLevel> buildTilePyramid(const OrganizedPoints& points,
                                        const AdaptiveParameters& parameters,
                                        unsigned int threads)
{
  std::vector<TileLevel> pyramid;
  buildTilePyramid(points, parameters, threads, pyramid);
  return pyramid;
}

void buildTilePyramid(const OrganizedPoints& points,
                      const AdaptiveParameters& parameters, unsigned int threads,
                      std::vector<TileLevel>& pyramid)
{
  pyramid.resize(static_cast<std::size_t>(parameters.levels));
  for (std::size_t l = 0; l < pyramid.size(); ++l) {
    TileLevel& level = pyramid[l];
    level.side = CELL << l;
    level.columns = (points.width + level.side - 1) / level.side;
    level.rows = (points.height + level.side - 1) / level.side;
    level.sums.resize(level.at(0, level.rows));
    if (l > 0)
      level.planes.resize(level.sums.size());
  }
  // A row of large tiles with all that it is made of stays in the nearest caches. Of the
  // largest ones there may be too few rows to be shared evenly.
  const std::size_t top = pyramid.size() - 1;
  const std::size_t shared = std::max<std::size_t>(top, 1) - 1;
  parallelParts(pyramid[shared].rows, threads, [&](int row) {
    for (std::size_t l = 0; l <= shared; ++l) {
      const TileRows part = rowsInside(pyramid[l], pyramid[shared], {row, row + 1});
      if (l == 0)
        sumCells(points, part, pyramid[l]);
      else
        makeTiles(pyramid[l - 1], part, parameters, pyramid[l]);
    }
  });
  if (top > shared)
    parallelParts(pyramid[top].rows, threads, [&](int row) {
      makeTiles(pyramid[top - 1], {row, row + 1}, parameters, pyramid[top]);
    });
}

} // namespace pcl_mrf_planes::adaptive
