// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief A closed walk around a connected part of a plane. */
struct LabelContour {
  std::uint16_t label = 0;
  std::vector<int> points; ///< indices; the first is not repeated
};

/** \brief Outer contours of the parts of all planes; parts under \a min_points are left
 * out. */
std::vector<LabelContour> contoursOf(const ViewFrame& frame, const SegmentedView& view,
                                     int min_points = 40);

} // namespace pcl_mrf_planes::viewer
