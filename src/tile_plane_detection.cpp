// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/tile_plane_detection.h>

#include "paper_stages.h"
#include "threads.h"

#include <algorithm>

namespace pcl_mrf_planes {

namespace {

/// The part of the image that a tile covers; ragged at the right and at the bottom.
struct TileBounds {
  int left, top, right, bottom; // right and bottom are one past the end
  /// The rays of one row or column of pixels lie on a plane through the sensor, which
  /// would fit without error and say nothing of the surface.
  bool isLine() const { return right - left == 1 || bottom - top == 1; }
  double area() const { return static_cast<double>(right - left) * (bottom - top); }
};

TileBounds boundsOf(const TileImage& image, const OrganizedPoints& points, int column,
                    int row)
{
  const int left = column * image.tile_width;
  const int top = row * image.tile_height;
  return {left, top, std::min(left + image.tile_width, points.width),
          std::min(top + image.tile_height, points.height)};
}

/// Invalid points are zeros, so the sums need no branch; only n asks the mask.
ScatterMatrix gatherSums(const OrganizedPoints& points, const TileBounds& tile)
{
  ScatterMatrix sums;
  for (int y = tile.top; y < tile.bottom; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(points.width);
    const std::size_t end = row + static_cast<std::size_t>(tile.right);
    int valid = 0;
    for (std::size_t i = row + static_cast<std::size_t>(tile.left); i < end; ++i) {
      const double px = points.x[i];
      const double py = points.y[i];
      const double pz = points.z[i];
      valid += points.valid[i];
      sums.x += px;
      sums.y += py;
      sums.z += pz;
      sums.xx += px * px;
      sums.xy += px * py;
      sums.xz += px * pz;
      sums.yy += py * py;
      sums.yz += py * pz;
      sums.zz += pz * pz;
    }
    sums.n += valid;
  }
  return sums;
}

TilePlane fitTile(const OrganizedPoints& points, const TileBounds& bounds,
                  const Parameters& parameters)
{
  TilePlane tile;
  tile.sums = gatherSums(points, bounds);
  if (tile.sums.n < 3.0 || tile.sums.n < parameters.min_valid_share * bounds.area())
    return tile;
  tile.depth = points.depthOf(tile.sums.centroid());
  tile.fit = fitPlane(tile.sums, parameters.fit);
  if (!tile.fit.valid || bounds.isLine()) {
    tile.state = TileState::DEGENERATE;
    return tile;
  }
  // "storing those having low fit-error": low is what the sensor's noise explains.
  const double threshold =
      parameters.noise_multiplier * parameters.noise.sigma(tile.depth);
  tile.state = tile.fit.rms <= threshold ? TileState::KEPT : TileState::BAD_FIT;
  return tile;
}

} // namespace

std::size_t TileImage::countKept() const
{
  return static_cast<std::size_t>(std::count_if(
      tiles.begin(), tiles.end(), [](const TilePlane& tile) { return tile.kept(); }));
}

TileImage detectTilePlanes(const OrganizedPoints& points, const Parameters& parameters)
{
  TileImage image;
  detectTilePlanes(points, parameters, image);
  return image;
}

void detectTilePlanes(const OrganizedPoints& points, const Parameters& parameters,
                      TileImage& image)
{
  image.tile_width = parameters.tile_width;
  image.tile_height = parameters.tile_height;
  image.columns = (points.width + image.tile_width - 1) / image.tile_width;
  image.rows = (points.height + image.tile_height - 1) / image.tile_height;
  image.tiles.resize(static_cast<std::size_t>(image.columns) *
                     static_cast<std::size_t>(image.rows));

  const ThreadTeam team(parameters.number_of_threads);
  parallelRows(image.rows, parameters.number_of_threads, [&](int row) {
    for (int column = 0; column < image.columns; ++column) {
      const std::size_t index =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(image.columns) +
          static_cast<std::size_t>(column);
      image.tiles[index] =
          fitTile(points, boundsOf(image, points, column, row), parameters);
    }
  });
}

} // namespace pcl_mrf_planes
