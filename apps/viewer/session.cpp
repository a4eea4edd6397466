// SPDX-License-Identifier: BSD-3-Clause
#include "session.h"

#include "parameter_file.h"
#include "parameter_options.h"

#include <algorithm>
#include <exception>
#include <set>
#include <utility>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double FASTEST = 60.0; // frames a second
constexpr double SLOWEST = 0.25;

template <typename Enum>
Enum following(Enum value, Enum last)
{
  return value == last ? Enum{} : static_cast<Enum>(static_cast<int>(value) + 1);
}

/// The track takes any frame that stays: that of the cloud does.
std::vector<Plane> sensorPlanes(const SegmentedView& view)
{
  std::vector<Plane> planes;
  for (const ViewPlane& plane : view.planes)
    planes.push_back({plane.normal, plane.d});
  return planes;
}

} // namespace

Session::Session(std::vector<io::FrameSource> frames, const Parameters& parameters,
                 Profile profile)
: frames_(std::move(frames))
, frame_(readFrame(frames_.at(0)))
, parameters_(parameters)
, profile_(profile)
{
  segment();
}

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
  if (action >= Action::BY_PLANE && action <= Action::BY_TILE_ERROR) {
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

bool Session::performSequence(Action action)
{
  switch (action) {
  case Action::PLAY:
    playing_ = !playing_ && (frames_.size() > 1 || settings.film);
    waited_ = 0.0;
    if (playing_ && !settings.film)
      lookAhead((index_ + 1) % frames_.size());
    if (!playing_ && frames_.size() == 1 && !settings.film)
      message_ = "there is one frame only; open a folder to play";
    return true;
  case Action::NEXT_FRAME:
    step(1);
    return true;
  case Action::PREVIOUS_FRAME:
    step(-1);
    return true;
  case Action::FASTER:
    speed_ = std::min(FASTEST, speed_ * 2.0);
    return true;
  case Action::SLOWER:
    speed_ = std::max(SLOWEST, speed_ / 2.0);
    return true;
  case Action::LOOP:
    loop_ = !loop_;
    return true;
  default:
    return false;
  }
}

bool Session::advance(double seconds)
{
  if (!playing_)
    return false;
  waited_ += seconds;
  const double period = 1.0 / speed_;
  if (waited_ < period)
    return false;
  // Frames that could not be shown in time are not caught up with.
  waited_ = std::min(waited_ - period, period);
  if (settings.film) {
    const int count = static_cast<int>(film_.steps.size());
    playing_ = loop_ || settings.film_step + 1 < count;
    if (playing_ && count > 0)
      settings.film_step = (settings.film_step + 1) % count;
    return true;
  }
  if (!loop_ && index_ + 1 == frames_.size()) {
    playing_ = false;
    return true;
  }
  step(1);
  return true;
}

void Session::step(int by)
{
  const auto count = static_cast<long>(frames_.size());
  const long wanted = static_cast<long>(index_) + by;
  if (!loop_ && (wanted < 0 || wanted >= count))
    return;
  const auto next = static_cast<std::size_t>((wanted + count) % count);
  if (next != index_ && !showFrame(next))
    index_ = next; // a broken frame is passed over, and does not stop the others
}

bool Session::showFrame(std::size_t index)
{
  const std::size_t count = frames_.size();
  const bool back = count > 2 && (index + 1) % count == index_;
  const bool shown = loadFrame(index);
  lookAhead((index + (back ? count - 1 : 1)) % count);
  return shown;
}

void Session::lookAhead(std::size_t index)
{
  if (index == index_ || ahead_.isFor(index))
    return;
  // Copies: the session may move and change meanwhile.
  ahead_.begin(index, [source = frames_.at(index), wanted = choice()] {
    return segmentFrame(source, wanted);
  });
}

bool Session::loadFrame(std::size_t index)
{
  try {
    SegmentedFrame loaded =
        ahead_.isFor(index) ? ahead_.take() : segmentFrame(frames_.at(index), choice());
    frame_ = std::move(loaded.frame);
    main_ = std::move(loaded.main);
    other_ = std::move(loaded.other);
    index_ = index;
    forgetPlanes();
    colour();
    return true;
  }
  catch (const std::exception& error) {
    message_ = error.what();
    return false;
  }
}

void Session::pick(long index)
{
  settings.picked_point = index;
  settings.selected =
      index < 0 ? std::uint16_t{0} : main_.labels[static_cast<std::size_t>(index)];
  if (settings.selected == 0)
    settings.isolate = false;
}

void Session::setParameters(const Parameters& parameters)
{
  const std::string complaint = parameters.validate();
  if (!complaint.empty()) {
    message_ = complaint;
    return;
  }
  parameters_ = parameters;
  ahead_.forget();
  const std::vector<std::uint32_t> before = main_colours_;
  segment();
  keepPlanes(before);
}

void Session::useSlider(std::size_t slider, double value)
{
  message_.clear();
  Parameters changed = parameters_;
  moveSlider(slidersOf(changed.method).at(slider), value, changed);
  setParameters(changed);
}

const FilmStep* Session::filmStep() const
{
  const auto step = static_cast<std::size_t>(settings.film_step);
  return settings.film && step < film_.steps.size() ? &film_.steps[step] : nullptr;
}

void Session::nextProfile()
{
  profile_ = following(profile_, Profile::PAPER);
  setParameters(Parameters::fromProfile(profile_));
  message_ = "profile " + profileName(profile_);
}

Choice Session::choice() const
{
  return {parameters_, profile_, settings.comparison};
}

void Session::segment()
{
  main_ = segmentMain(frame_, choice());
  colour();
}

void Session::colour()
{
  main_colours_ = track_.update(sensorPlanes(main_), main_.labels);
  colourOther();
  updateStages();
}

void Session::colourOther()
{
  // The same colours on both sides where the planes are the same.
  apps::ColourTrack own = track_;
  other_colours_ = own.update(sensorPlanes(other_), other_.labels);
}

void Session::updateStages()
{
  if (!settings.tiles && !settings.film && settings.mode != ColourMode::TILE_ERROR)
    return;
  const SegmentationStages stages = recordStages(frame_.points, parameters_);
  tiles_ = tilesOf(stages);
  apps::ColourTrack own = track_;
  tiles_.classes = own.update(stages.merged_planes, tiles_.mergedLabels());
  if (!settings.film)
    return;
  film_ = filmOf(stages, tiles_, track_);
  const int last = static_cast<int>(film_.steps.size()) - 1;
  settings.film_step = std::max(0, std::min(last, settings.film_step));
}

void Session::forgetPlanes()
{
  settings.selected = 0;
  settings.picked_point = -1;
  settings.isolate = false;
  settings.hidden.clear();
}

void Session::keepPlanes(const std::vector<std::uint32_t>& before)
{
  // A plane is the same one while it keeps its colour, whatever its number.
  const auto now = [&](std::uint16_t label) -> std::uint16_t {
    if (label == 0 || label > before.size())
      return 0;
    const auto found =
        std::find(main_colours_.begin(), main_colours_.end(), before[label - 1u]);
    return found == main_colours_.end()
               ? std::uint16_t{0}
               : static_cast<std::uint16_t>(found - main_colours_.begin() + 1);
  };
  std::set<std::uint16_t> hidden;
  for (const std::uint16_t label : settings.hidden)
    if (const std::uint16_t kept = now(label))
      hidden.insert(kept);
  settings.hidden = std::move(hidden);
  if (settings.picked_point >= 0) {
    pick(settings.picked_point); // what it is on now
    return;
  }
  settings.selected = now(settings.selected);
  settings.isolate = settings.isolate && settings.selected != 0;
}

std::string Session::parameterFile() const
{
  return parameter_file_.empty() ? "viewer_parameters.txt" : parameter_file_;
}

void Session::saveParameters()
{
  try {
    apps::writeParameterFile(parameterFile(), {profileName(profile_), parameters_});
    message_ = "parameters are in " + parameterFile();
  }
  catch (const std::exception& error) {
    message_ = error.what();
  }
}

void Session::loadParameters()
{
  try {
    const apps::ParameterSet set = apps::readParameterFile(parameterFile());
    profile_ = apps::profileFromName(set.profile);
    setParameters(set.parameters);
    if (message_.empty())
      message_ = "parameters of " + parameterFile();
  }
  catch (const std::exception& error) {
    message_ = error.what();
  }
}

} // namespace pcl_mrf_planes::viewer
