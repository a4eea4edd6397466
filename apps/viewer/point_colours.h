// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"
#include "tile_cells.h"
#include "view_settings.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief What the colours of rampColour() stand for. */
struct ColourScale {
  std::string quantity; ///< with its unit
  double low = 0.0;     ///< at share 0
  double high = 1.0;
  bool logarithmic = false; ///< equal steps are equal factors

  /** \brief Place of a value on the ramp, 0 to 1 within the scale. */
  double shareOf(double value) const;
};

/** \brief Colours of all points, and what they mean. */
struct PointColours {
  std::vector<io::Colour> colours;
  std::vector<bool> shown;          ///< valid, and not hidden
  std::string legend;               ///< a line for the window
  std::optional<ColourScale> scale; ///< of colours by value
};

/** \brief Colour that runs from dark blue over green to yellow, after viridis: even in
 * lightness and safe for colour-blind people. \param[in] share 0 to 1, clamped */
io::Colour rampColour(double share);

/** \brief Colours by the settings' mode, selection and hidden planes.
 * \param[in] tiles needed for ColourMode::TILE_ERROR only
 * \param[in] classes colour class of each plane; a plane without one has its label's
 * \param[in] same_scale range of values of a picture to compare with */
PointColours colourPoints(const ViewFrame& frame, const SegmentedView& view,
                          const TileCells& tiles, const ViewSettings& settings,
                          const std::vector<std::uint32_t>& classes,
                          const std::optional<ColourScale>& same_scale = {});

} // namespace pcl_mrf_planes::viewer
