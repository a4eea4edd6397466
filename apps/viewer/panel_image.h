// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"
#include "view_settings.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief The label image over colour or depth, row by row from the top; over depth where
 * the cloud has no colours. Or colour, with shading in its place, and below it depth, near
 * dark and far bright. Points that were not measured are black.
 * \param[in] classes colour of each plane */
io::ColourImage panelImage(const ViewFrame& frame, const SegmentedView& view,
                           Panel panel, const std::vector<std::uint32_t>& classes);

} // namespace pcl_mrf_planes::viewer
