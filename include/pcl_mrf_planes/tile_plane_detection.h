// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/scatter_matrix.h>

#include <cstddef>
#include <vector>

namespace pcl_mrf_planes {

/** \brief What became of one tile. */
enum class TileState {
  KEPT,       ///< a plane with low fit-error: it goes on to the merging
  TOO_FEW,    ///< fewer valid points than min_valid_share asks for
  DEGENERATE, ///< points on a line or in one spot, or of one row or column of pixels
  BAD_FIT     ///< root mean square distance above the noise
};

/** \brief The plane of one tile: a pixel of the "image of planar fits". */
struct PCL_MRF_PLANES_EXPORT TilePlane {
  TileState state = TileState::TOO_FEW; ///< what became of it
  ScatterMatrix sums;                   ///< of the tile's valid points
  PlaneFitResult fit;                   ///< of tiles that are KEPT or BAD_FIT
  double depth = 0.0; ///< depth of the centroid in metres, where sigma is taken

  /// Whether its plane goes on to the merging.
  bool kept() const { return state == TileState::KEPT; }
};

/** \brief The image of planar fits: tile (column, row) at row * columns + column. */
struct PCL_MRF_PLANES_EXPORT TileImage {
  int tile_width = 0;           ///< points
  int tile_height = 0;          ///< points
  int columns = 0;              ///< tiles beside each other
  int rows = 0;                 ///< tiles below each other
  std::vector<TilePlane> tiles; ///< row by row

  /** \brief Index of the tile that holds point (x, y). */
  std::size_t tileAt(int x, int y) const
  {
    return static_cast<std::size_t>(y / tile_height) *
               static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(x / tile_width);
  }

  /** \brief Number of tiles whose plane goes on to the merging. */
  std::size_t countKept() const;
};

/** \brief Detect planar surfaces: one least-squares plane per tile, section IV-A.
 *
 * Tiles the image, gathers the ten sums of every tile in one pass over the points,
 * fits, and keeps the planes with low fit-error. The last tile of a row or column holds
 * what is left. O(points + tiles); parallel over rows of tiles, the same at any thread
 * count.
 */
PCL_MRF_PLANES_EXPORT TileImage detectTilePlanes(const OrganizedPoints& points,
                                                 const Parameters& parameters);

} // namespace pcl_mrf_planes
