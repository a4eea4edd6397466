// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/tile_pyramid.h"
#include <algorithm>

namespace pcl_mrf_planes::adaptive {

namespace {

TileSums sumTile(const OrganizedPoints& points, int u0, int v0, int side)
{
  TileSums s;
  const int u1 = std::min(points.width, u0 + side);
  const int v1 = std::min(points.height, v0 + side);
  for (int v = v0; v < v1; ++v)
    for (int u = u0; u < u1; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(points.width) +
          static_cast<std::size_t>(u);
      if (points.valid[i])
        s.add(points.x[i], points.y[i], points.z[i]);
    }
  return s;
}

void fitTiles(TileLevel& level, double min_fill)
{
  const double least = min_fill * level.side * level.side;
  level.planes.assign(level.sums.size(), FittedPlane());
  for (std::size_t i = 0; i < level.sums.size(); ++i)
    if (level.sums[i].n >= least)
      level.planes[i] = fitSums(level.sums[i]);
}

} // namespace

std::vector<TileLevel> buildTilePyramid(const OrganizedPoints& points,
                                        const AdaptiveParameters& parameters)
{
  std::vector<TileLevel> pyramid(static_cast<std::size_t>(parameters.levels));
  for (std::size_t l = 0; l < pyramid.size(); ++l) {
    TileLevel& level = pyramid[l];
    level.side = parameters.cell << l;
    level.columns = (points.width + level.side - 1) / level.side;
    level.rows = (points.height + level.side - 1) / level.side;
    level.sums.resize(level.at(0, level.rows));
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.columns; ++c) {
        TileSums& s = level.sums[level.at(c, r)];
        if (l == 0) {
          s = sumTile(points, c * level.side, r * level.side, level.side);
          continue;
        }
        const TileLevel& below = pyramid[l - 1];
        for (int j = 2 * r; j < std::min(2 * r + 2, below.rows); ++j)
          for (int i = 2 * c; i < std::min(2 * c + 2, below.columns); ++i)
            s += below.sums[below.at(i, j)];
      }
    fitTiles(level, parameters.min_fill);
  }
  return pyramid;
}

} // namespace pcl_mrf_planes::adaptive
