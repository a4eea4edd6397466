// SPDX-License-Identifier: BSD-3-Clause
/** \file What keys do to a session: its view, its planes. */
#include "session.h"

#include <algorithm>

namespace pcl_mrf_planes::viewer {

void Session::perform(Action action)
{
  message_.clear();
  if (performView(action) || performPlane(action) || performSequence(action))
    return;
  if (action == Action::PROFILE)
    nextProfile();
  else if (action == Action::SAVE_PARAMETERS)
    saveParameters();
  else if (action == Action::LOAD_PARAMETERS)
    loadParameters();
}

bool Session::performView(Action action)
{
  const auto toggle = [](bool& value) {
    value = !value;
    return true;
  };
  if (action >= Action::BY_PLANE && action <= Action::BY_GIVEN_LABEL) {
    settings.mode = static_cast<ColourMode>(static_cast<int>(action) -
                                            static_cast<int>(Action::BY_PLANE));
    settings.film = false;
    updateStages();
    return true;
  }
  switch (action) {
  case Action::HELP:
    return toggle(settings.help);
  case Action::CONTOURS:
    return toggle(settings.contours);
  case Action::NORMALS:
    return toggle(settings.normals);
  case Action::CREASES:
    return toggle(settings.creases);
  case Action::PROJECTION:
    return toggle(settings.projected);
  case Action::SLIDERS:
    return toggle(settings.sliders);
  case Action::FACTS:
    return toggle(settings.facts);
  case Action::BACKGROUND:
    return toggle(settings.dark);
  case Action::TILES:
    toggle(settings.tiles);
    updateStages();
    return true;
  case Action::PANEL:
    settings.panel = following(settings.panel, Panel::COLOUR_AND_DEPTH);
    return true;
  case Action::SHAPES:
    settings.shapes = following(settings.shapes, Shapes::HULLS);
    return true;
  case Action::COMPARE:
    settings.comparison = following(settings.comparison, Comparison::PCL);
    ahead_.forget();
    other_ = segmentOther(frame_, settings.comparison);
    colourOther();
    return true;
  case Action::FILM:
    toggle(settings.film);
    settings.film_step = 0;
    updateStages();
    return true;
  case Action::FILM_FORWARD:
  case Action::FILM_BACK: {
    const int last = static_cast<int>(film_.steps.size()) - 1;
    const int by = action == Action::FILM_FORWARD ? 1 : -1;
    settings.film_step = std::max(0, std::min(last, settings.film_step + by));
    return true;
  }
  default:
    return false;
  }
}

bool Session::performPlane(Action action)
{
  const auto count = static_cast<std::uint16_t>(main_.planes.size());
  switch (action) {
  case Action::SELECT_NEXT:
    settings.picked_point = -1;
    settings.selected = settings.selected >= count
                            ? std::uint16_t{0}
                            : static_cast<std::uint16_t>(settings.selected + 1);
    return true;
  case Action::DESELECT:
    pick(-1);
    return true;
  case Action::HIDE:
    if (settings.selected == 0)
      message_ = "no plane is selected; click on one or press tab";
    else
      settings.hidden.insert(settings.selected);
    settings.selected = 0;
    settings.picked_point = -1;
    return true;
  case Action::ISOLATE:
    if (settings.selected == 0 && !settings.isolate)
      message_ = "no plane is selected; click on one or press tab";
    else
      settings.isolate = !settings.isolate;
    return true;
  case Action::SHOW_ALL:
    settings.hidden.clear();
    settings.isolate = false;
    return true;
  default:
    return false;
  }
}

void Session::nextProfile()
{
  profile_ = following(profile_, Profile::PAPER);
  setParameters(Parameters::fromProfile(profile_));
  message_ = "profile " + profileName(profile_);
}

} // namespace pcl_mrf_planes::viewer
