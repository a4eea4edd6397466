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
