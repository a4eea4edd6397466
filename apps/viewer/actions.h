// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief Everything that a key does. */
enum class Action {
  HELP,
  BY_PLANE,
  BY_DEPTH,
  BY_OWN_COLOUR,
  BY_CONFIDENCE,
  BY_DISTANCE,
  BY_TILE_ERROR,
  BY_DEVIATION,
  BY_GIVEN_LABEL,
  CONTOURS,
  NORMALS,
  CREASES,
  SHAPES,
  PROJECTION,
  TILES,
  PANEL,
  COMPARE,
  FILM,
  FILM_FORWARD,
  FILM_BACK,
  SLIDERS,
  PROFILE,
  FACTS,
  BACKGROUND,
  SELECT_NEXT,
  DESELECT,
  HIDE,
  ISOLATE,
  SHOW_ALL,
  PLAY,
  NEXT_FRAME,
  PREVIOUS_FRAME,
  FASTER,
  SLOWER,
  LOOP,
  RESET_CAMERA,
  FACE_PLANE,
  SCREENSHOT,
  SAVE_PARAMETERS,
  LOAD_PARAMETERS,
  QUIT
};

/** \brief A key and what it does; the help is made from these. */
struct KeyBinding {
  std::string key;   ///< X's name of the key (keysym), as VTK gives it
  std::string shown; ///< for the help
  Action action;
  std::string help;
};

/** \brief All keys, in the order of the help. */
const std::vector<KeyBinding>& keyBindings();

/** \brief The action of a key, if it has one. */
std::optional<Action> actionOfKey(const std::string& key);

/** \brief The help, a line for every key. */
std::string keyHelp();

} // namespace pcl_mrf_planes::viewer
