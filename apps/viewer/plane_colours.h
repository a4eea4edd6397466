// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief Colours that stay with their planes while parameters change and frames pass. */
class PlaneColours {
public:
  /** \brief Colour number of each plane of a result, from 1 on: that of the plane of the
   * last result which most of its points had, else one that is free.
   * O(points + planes^2) */
  std::vector<std::uint32_t> follow(const SegmentedView& view);

private:
  std::vector<std::uint16_t> labels_; ///< of the last result
  std::vector<std::uint32_t> colours_;
};

} // namespace pcl_mrf_planes::viewer
