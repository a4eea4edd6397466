// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/noise_estimation.h"
#include "adaptive/tile_pyramid.h"

#include <vector>

namespace pcl_mrf_planes::adaptive {

/// What a random field knows of the noise of its points, kept for what comes after it.
struct BlockNoise {
  /// Some of the sums of a block.
  struct Block {
    double n, x, y, z, noise;

    /// Of the centroid, m; one without points is as if it were at one metre.
    double range() const
    {
      return n > 0 ? Eigen::Vector3d(x / n, y / n, z / n).norm() : 1.0;
    }
    /// Of the small-scale noise of its points, m^2.
    double variance() const { return n > 0 ? noise / n : 1.0; }
  };

  NoiseLaw noise;
  std::vector<Block> blocks; ///< of BLOCK_LEVEL of the tile pyramid

  void assign(const NoiseLaw& law, const TileLevel& of_blocks)
  {
    noise = law;
    blocks.clear();
    blocks.reserve(of_blocks.sums.size());
    for (const TileSums& sums : of_blocks.sums)
      blocks.push_back({sums.n, sums.x, sums.y, sums.z, sums.noise});
  }
};

} // namespace pcl_mrf_planes::adaptive
