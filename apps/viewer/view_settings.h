// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>

namespace pcl_mrf_planes::viewer {

/** \brief What a point's colour stands for. */
enum class ColourMode {
  PLANE,
  DEPTH,
  OWN,
  CONFIDENCE,
  DISTANCE,
  TILE_ERROR,
  DEVIATION,
  GIVEN_LABEL
};

/** \brief What stands on the right half of the window. */
enum class Comparison { OFF, DEFAULT, FAST, PAPER, PCL };

/** \brief What the 2-D panel shows. */
enum class Panel { OFF, LABELS_ON_COLOUR, LABELS_ON_DEPTH, COLOUR_AND_DEPTH };

/** \brief How the shape of the planes is shown. */
enum class Shapes { OFF, POLYGONS, HULLS };

/** \brief The value after \a value, and after \a last the first. */
template <typename Enum>
Enum following(Enum value, Enum last)
{
  return value == last ? Enum{} : static_cast<Enum>(static_cast<int>(value) + 1);
}

/** \brief How the result is shown. */
struct ViewSettings {
  ColourMode mode = ColourMode::PLANE;
  Comparison comparison = Comparison::OFF;
  Panel panel = Panel::OFF;
  Shapes shapes = Shapes::OFF;
  bool contours = false;
  bool normals = false;
  bool creases = false;
  bool projected = false; ///< points are moved onto their planes
  bool tiles = false;
  bool sliders = false;
  bool help = false;
  bool facts = true;
  bool dark = true;
  bool film = false;
  int film_step = 0;
  std::uint16_t selected = 0; ///< label of the picked plane, 0 none
  long picked_point = -1;     ///< index of the picked point, -1 none
  bool isolate = false;       ///< only the selected plane is shown
  std::set<std::uint16_t> hidden;

  /** \brief Whether anything of a plane is to be seen; label 0: of no plane. */
  bool shows(std::uint16_t label) const
  {
    return hidden.count(label) == 0 && (!isolate || (label != 0 && label == selected));
  }
};

} // namespace pcl_mrf_planes::viewer
