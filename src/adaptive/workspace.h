// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/block_noise.h"
#include "adaptive/candidate_field.h"
#include "adaptive/tile_pyramid.h"
#include "region_gathering.h"

#include <pcl_mrf_planes/organized_points.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/** \brief Memory of the stages, kept from one cloud to the next: it is in the caches then,
 * and need not be cleared. What it holds in between means nothing. */
struct Workspace {
  OrganizedPoints samples;
  std::vector<TileLevel> pyramid;
  FieldMemory field;
  BeliefMemory beliefs;
  std::vector<std::uint16_t> labels; ///< of the samples
  RegionMemory regions;
  std::shared_ptr<BlockNoise> noise; ///< where no result has it
};

} // namespace pcl_mrf_planes::adaptive
