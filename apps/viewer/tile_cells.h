// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/segmentation_stages.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief The tiles of a frame, as the method of the parameters looked at them, and what
 * each merged into. */
struct TileCells {
  std::vector<StageTile> tiles;
  std::vector<int> tile_of_point;     ///< -1: in no tile
  std::vector<std::uint32_t> classes; ///< colour of each merged plane

  /** \brief Labels of all points by their tiles: 0 not kept, k merged plane k - 1. */
  std::vector<std::uint16_t> mergedLabels() const;
};

/** \brief The tiles of recorded stages; where tiles lie in each other, the kept one that
 * was recorded first counts. \a classes stays empty */
TileCells tilesOf(const SegmentationStages& stages);

} // namespace pcl_mrf_planes::viewer
