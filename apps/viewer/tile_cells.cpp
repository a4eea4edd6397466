// SPDX-License-Identifier: BSD-3-Clause
#include "tile_cells.h"

namespace pcl_mrf_planes::viewer {

std::uint16_t TileCells::labelAt(int x, int y) const
{
  const int plane = clusters.assignment[image.tileAt(x, y)];
  return plane == PlaneClusters::NONE ? std::uint16_t{0}
                                      : static_cast<std::uint16_t>(plane + 1);
}

TileCells fitTiles(const ViewFrame& frame, const Parameters& parameters)
{
  TileCells cells;
  cells.image = detectTilePlanes(frame.points, parameters);
  cells.clusters = clusterTilePlanes(cells.image, parameters);
  return cells;
}

} // namespace pcl_mrf_planes::viewer
