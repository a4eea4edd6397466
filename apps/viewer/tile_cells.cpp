// SPDX-License-Identifier: BSD-3-Clause
#include "tile_cells.h"

namespace pcl_mrf_planes::viewer {

namespace {

void claimPoints(const StageTile& tile, int index, int image_width,
                 std::vector<int>& tile_of_point)
{
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const int i = y * image_width + x;
      int& owner = tile_of_point[static_cast<std::size_t>(i)];
      if (owner < 0)
        owner = index;
    }
}

} // namespace

std::vector<std::uint16_t> TileCells::mergedLabels() const
{
  std::vector<std::uint16_t> labels(tile_of_point.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (tile_of_point[i] >= 0)
      labels[i] = static_cast<std::uint16_t>(
          tiles[static_cast<std::size_t>(tile_of_point[i])].merged + 1);
  return labels;
}

TileCells tilesOf(const SegmentationStages& stages)
{
  TileCells cells;
  cells.tiles = stages.tiles;
  cells.tile_of_point.assign(static_cast<std::size_t>(stages.width) *
                                 static_cast<std::size_t>(stages.height),
                             -1);
  for (const bool kept : {true, false})
    for (std::size_t t = 0; t < cells.tiles.size(); ++t)
      if (cells.tiles[t].kept == kept)
        claimPoints(cells.tiles[t], static_cast<int>(t), stages.width,
                    cells.tile_of_point);
  return cells;
}

} // namespace pcl_mrf_planes::viewer
