// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/noise_estimation.h"
#include "adaptive/tile_sums.h"

#include <vector>

namespace pcl_mrf_planes::adaptive {

/// What a random field knows of the noise of its points, kept for what comes after it.
struct BlockNoise {
  NoiseLaw noise;
  std::vector<TileSums> blocks; ///< of BLOCK_LEVEL of the tile pyramid
};

} // namespace pcl_mrf_planes::adaptive
