// SPDX-License-Identifier: BSD-3-Clause
#include "cell_sums.h"

#include "adaptive/tile_sums_kernel.h"

namespace pcl_mrf_planes::benchmarks {

void sumAllCells(const OrganizedPoints& points, std::vector<adaptive::TileSums>& sums)
{
  constexpr int SIDE = 4;
  const auto width = static_cast<std::size_t>(points.width);
  const std::size_t columns = width / SIDE;
  const int rows = points.height / SIDE;
  sums.resize(columns * static_cast<std::size_t>(rows));
  for (int row = 0; row < rows; ++row) {
    const std::size_t first = static_cast<std::size_t>(row * SIDE) * width;
    const adaptive::TileStrip strip = {&points.x[first],
                                       &points.y[first],
                                       &points.z[first],
                                       &points.valid[first],
                                       width,
                                       SIDE};
    adaptive::sumTiles(strip, columns, &sums[static_cast<std::size_t>(row) * columns]);
  }
}

} // namespace pcl_mrf_planes::benchmarks
