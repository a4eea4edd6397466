// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/tile_sums.h"
#include <pcl_mrf_planes/adaptive_parameters.h>
#include <pcl_mrf_planes/organized_points.h>

namespace pcl_mrf_planes::adaptive {

/** \brief Sums and planes of the tiles of one size. */
struct TileLevel {
  int side = 0; ///< [px]
  int columns = 0;
  int rows = 0;
  std::vector<TileSums> sums;
  std::vector<FittedPlane> planes;

  std::size_t at(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/** \brief Tiles of doubling side; each level is summed from the one below.
 * O(points) for the first level, O(cells) for the rest. */
std::vector<TileLevel> buildTilePyramid(const OrganizedPoints& points,
                                        const AdaptiveParameters& parameters);

} // namespace pcl_mrf_planes::adaptive
