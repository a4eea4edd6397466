// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"
#include "tile_cells.h"
#include "view_settings.h"

#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief Colours of all points, and what they mean. */
struct PointColours {
  std::vector<io::Colour> colours;
  std::vector<bool> shown; ///< valid, and not hidden
  std::string legend;      ///< a line for the window
};

/** \brief Colour that runs from dark blue over green to yellow, after viridis: even in
 * lightness and safe for colour-blind people. \param[in] share 0 to 1, clamped */
io::Colour rampColour(double share);

/** \brief Colours by the settings' mode, selection and hidden planes.
 * \param[in] tiles needed for ColourMode::TILE_ERROR only
 * \param[in] classes colour class of each plane; a plane without one has its label's */
PointColours colourPoints(const ViewFrame& frame, const SegmentedView& view,
                          const TileCells& tiles, const ViewSettings& settings,
                          const std::vector<std::uint32_t>& classes);

} // namespace pcl_mrf_planes::viewer
