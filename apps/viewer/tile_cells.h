// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view_frame.h"

#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_clustering.h>
#include <pcl_mrf_planes/tile_plane_detection.h>

namespace pcl_mrf_planes::viewer {

/** \brief The image of planar fits of a frame, and what each tile merged into. */
struct TileCells {
  TileImage image;
  PlaneClusters clusters; ///< assignment of every tile: label plane, or NONE

  /** \brief Label of the tile of point (x, y): 0 was not kept, k the plane k - 1. */
  std::uint16_t labelAt(int x, int y) const;
};

/** \brief Fit and merge the tiles of a frame, sections IV-A and IV-B of the paper. */
TileCells fitTiles(const ViewFrame& frame, const Parameters& parameters);

} // namespace pcl_mrf_planes::viewer
