// SPDX-License-Identifier: BSD-3-Clause
#include "actions.h"

#include <algorithm>

namespace pcl_mrf_planes::viewer {

const std::vector<KeyBinding>& keyBindings()
{
  static const std::vector<KeyBinding> all = {
      {"h", "h", Action::HELP, "this help"},
      {"1", "1", Action::BY_PLANE, "colour by plane"},
      {"2", "2", Action::BY_DEPTH, "colour by depth"},
      {"3", "3", Action::BY_OWN_COLOUR, "the cloud's own colours"},
      {"4", "4", Action::BY_CONFIDENCE, "colour by confidence"},
      {"5", "5", Action::BY_DISTANCE, "colour by distance to the plane"},
      {"6", "6", Action::BY_TILE_ERROR, "colour by the tiles' fit error"},
      {"7", "7", Action::BY_DEVIATION, "colour by how well the plane is known"},
      {"8", "8", Action::BY_GIVEN_LABEL, "colour by labels that the file has"},
      {"c", "c", Action::CONTOURS, "contours"},
      {"n", "n", Action::NORMALS, "normals and numbers of the planes"},
      {"g", "g", Action::CREASES, "creases, with the angle between the normals"},
      {"x", "x", Action::SHAPES, "shapes: polygons with holes, convex hulls, off"},
      {"j", "j", Action::PROJECTION, "points on their planes, or as measured"},
      {"t", "t", Action::TILES, "tiles, in the colour they merged into"},
      {"i", "i", Action::PANEL,
       "image: labels over colour, over depth; colour and depth; off"},
      {"v", "v", Action::COMPARE, "beside it: default, fast, paper, PCL, off"},
      {"a", "a", Action::FILM, "the algorithm as a film"},
      {"Up", "up", Action::FILM_FORWARD, "film: next step"},
      {"Down", "down", Action::FILM_BACK, "film: step back"},
      {"s", "s", Action::SLIDERS, "sliders of the parameters"},
      {"p", "p", Action::PROFILE, "next profile: default, fast, paper"},
      {"f", "f", Action::FACTS, "counts and times"},
      {"b", "b", Action::BACKGROUND, "dark or light background"},
      {"Tab", "tab", Action::SELECT_NEXT, "select the next plane"},
      {"Escape", "esc", Action::DESELECT, "select none (click: pick a point)"},
      {"d", "d", Action::HIDE, "hide the selected plane"},
      {"o", "o", Action::ISOLATE, "only the selected plane"},
      {"u", "u", Action::SHOW_ALL, "show all planes again"},
      {"space", "space", Action::PLAY, "play or pause"},
      {"Right", "right", Action::NEXT_FRAME, "next frame"},
      {"Left", "left", Action::PREVIOUS_FRAME, "previous frame"},
      {"plus", "+", Action::FASTER, "play faster"},
      {"minus", "-", Action::SLOWER, "play slower"},
      {"l", "l", Action::LOOP, "loop on or off"},
      {"r", "r", Action::RESET_CAMERA, "look from the sensor again"},
      {"y", "y", Action::FACE_PLANE, "face the selected plane; none: from above"},
      {"k", "k", Action::SCREENSHOT, "save a picture"},
      {"w", "w", Action::SAVE_PARAMETERS, "write the parameters to their file"},
      {"e", "e", Action::LOAD_PARAMETERS, "read the parameters from their file"},
      {"q", "q", Action::QUIT, "quit"}};
  return all;
}

std::optional<Action> actionOfKey(const std::string& key)
{
  const auto& all = keyBindings();
  const auto found = std::find_if(all.begin(), all.end(), [&](const KeyBinding& b) {
    return b.key == key || b.shown == key;
  });
  if (found == all.end())
    return std::nullopt;
  return found->action;
}

std::string keyHelp()
{
  std::string text;
  for (const KeyBinding& binding : keyBindings()) {
    std::string key = binding.shown;
    key.resize(7, ' ');
    text += key + binding.help + '\n';
  }
  return text;
}

} // namespace pcl_mrf_planes::viewer
