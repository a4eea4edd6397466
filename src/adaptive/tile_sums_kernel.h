// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/tile_sums.h"

#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes::adaptive {

/// Where a strip of tiles lies in the planes of an OrganizedPoints.
struct TileStrip {
  const float* x;
  const float* y;
  const float* z;
  const std::uint8_t* valid;
  std::size_t width; ///< points from a row to the next
  int rows;          ///< of points, 1 to 4
};

/// The ten sums of equation (4) of neighbouring tiles of 4 points a row, in one pass.
/// Points that are not valid must have coordinates 0. The same bits for every instruction
/// set: columns are summed downwards, then (1st + 2nd) + (3rd + 4th).
void sumTiles(const TileStrip& strip, std::size_t tiles, TileSums* sums);

} // namespace pcl_mrf_planes::adaptive
