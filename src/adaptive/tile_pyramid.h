// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/tile_sums.h"
#include <pcl_mrf_planes/adaptive_parameters.h>
#include <pcl_mrf_planes/organized_points.h>

#include <algorithm>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Side of the smallest tiles, points.
constexpr int CELL = 4;

/// Levels that a pyramid may have.
constexpr std::size_t MOST_LEVELS = 8;

/// Level of the tiles that are the blocks of the random field.
constexpr std::size_t BLOCK_LEVEL = 1;

/** \brief Sums and planes of the tiles of one size. */
struct TileLevel {
  int side = 0; ///< [px]
  int columns = 0;
  int rows = 0;
  std::vector<TileSums> sums;
  /// Planes of no points where too few are valid; none at all of the smallest tiles: few of
  /// them are needed.
  std::vector<FittedPlane> planes;

  std::size_t at(int column, int row) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/** \brief Some rows of the tiles of a level, half open. */
struct TileRows {
  int begin, end;
};

/** \brief The rows of a level that some rows of larger tiles are made of. */
inline TileRows rowsInside(const TileLevel& level, const TileLevel& larger,
                           TileRows rows)
{
  const int side = larger.side / level.side;
  return {std::min(rows.begin * side, level.rows),
          std::min(rows.end * side, level.rows)};
}

/** \brief Whether enough points of a tile are valid for it to have a plane. */
inline bool isFilled(const TileLevel& level, std::size_t tile,
                     const AdaptiveParameters& parameters)
{
  return level.sums[tile].n >= parameters.min_fill * level.side * level.side;
}

/** \brief Tiles of doubling side; each level is summed from the one below.
 * O(points) for the first level, O(cells) for the rest. */
std::vector<TileLevel> buildTilePyramid(const OrganizedPoints& points,
                                        const AdaptiveParameters& parameters,
                                        unsigned int threads = 1);

/** \brief The same in the memory of another one. */
void buildTilePyramid(const OrganizedPoints& points,
                      const AdaptiveParameters& parameters, unsigned int threads,
                      std::vector<TileLevel>& pyramid);

} // namespace pcl_mrf_planes::adaptive
