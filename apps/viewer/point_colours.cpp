// SPDX-License-Identifier: BSD-3-Clause
#include "point_colours.h"

#include "label_colours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();
constexpr io::Colour NO_VALUE = {110, 110, 110};
constexpr double DIMMED = 0.35; // share of colour left to planes that are not selected

struct Range {
  double low = 0.0;
  double high = 1.0;
};

/// All but the outermost twentieths: a few stray values must not use up the ramp.
Range rangeOf(std::vector<double> values)
{
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](double v) { return !std::isfinite(v); }),
               values.end());
  if (values.empty())
    return {};
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share *
                                           static_cast<double>(values.size() - 1))];
  };
  return {at(0.02), std::max(at(0.98), at(0.02) + 1e-9)};
}

double tileError(const TileCells& cells, std::size_t i)
{
  const int tile = cells.tile_of_point[i];
  if (tile < 0 || !cells.tiles[static_cast<std::size_t>(tile)].kept)
    return NOTHING;
  return cells.tiles[static_cast<std::size_t>(tile)].rms;
}

Eigen::Vector3d pointOf(const ViewFrame& frame, std::size_t i)
{
  return (*frame.cloud)[i].getVector3fMap().cast<double>();
}

std::vector<double> valuesOf(const ViewFrame& frame, const SegmentedView& view,
                             const TileCells& tiles, ColourMode mode)
{
  std::vector<double> values(frame.points.size(), NOTHING);
  std::vector<PlaneDeviations> deviations;
  if (mode == ColourMode::DEVIATION && view.deviations)
    deviations = view.deviations();
  std::vector<float> confidence;
  if (mode == ColourMode::CONFIDENCE && view.confidence)
    confidence = view.confidence();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (frame.points.valid[i] == 0)
      continue;
    if (mode == ColourMode::DEPTH)
      values[i] = static_cast<double>(frame.points.depth(i));
    else if (mode == ColourMode::DISTANCE)
      values[i] = 1000.0 * std::abs(distanceToPlane(frame, view, i));
    else if (mode == ColourMode::TILE_ERROR && i < tiles.tile_of_point.size())
      values[i] = 1000.0 * tileError(tiles, i);
    else if (mode == ColourMode::DEVIATION && view.labels[i] != 0 &&
             view.labels[i] <= deviations.size())
      values[i] =
          1000.0 * deviationAt(pointOf(frame, i), deviations[view.labels[i] - 1u]);
    else if (mode == ColourMode::CONFIDENCE && i < confidence.size() &&
             view.labels[i] != 0)
      values[i] = static_cast<double>(confidence[i]);
  }
  return values;
}

ColourScale scaleOf(ColourMode mode, const std::vector<double>& values)
{
  if (mode == ColourMode::CONFIDENCE)
    return {"confidence", 0.0, 1.0};
  const Range range = rangeOf(values);
  if (mode == ColourMode::DEVIATION) // of planes near and far, large and small
    return {"standard deviation of the plane there, mm", std::max(1e-6, range.low),
            std::max(2e-6, range.high), true};
  const char* quantity = mode == ColourMode::DEPTH ? "depth, m"
                         : mode == ColourMode::DISTANCE
                             ? "distance to the plane, mm"
                             : "rms distance of the tile, mm";
  return {quantity, range.low, range.high};
}

void colourByValue(const ViewFrame& frame, const SegmentedView& view,
                   const TileCells& tiles, ColourMode mode,
                   const std::optional<ColourScale>& same_scale, PointColours& result)
{
  const std::vector<double> values = valuesOf(frame, view, tiles, mode);
  const ColourScale scale = same_scale ? *same_scale : scaleOf(mode, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    result.colours[i] =
        std::isfinite(values[i]) ? rampColour(scale.shareOf(values[i])) : NO_VALUE;
  result.scale = scale;
  result.legend = "colour: " + scale.quantity + "; grey none";
}

void colourByPlane(const SegmentedView& view, const std::vector<std::uint32_t>& classes,
                   PointColours& result)
{
  std::vector<io::Colour> palette = {apps::labelColour(0)};
  for (std::size_t k = 0; k < view.planes.size(); ++k)
    palette.push_back(apps::labelColour(
        k < classes.size() ? classes[k] : static_cast<std::uint32_t>(k + 1)));
  for (std::size_t i = 0; i < view.labels.size(); ++i)
    result.colours[i] = palette[view.labels[i]];
  result.legend = "colour: plane, grey none";
}

void colourByGivenLabel(const ViewFrame& frame, PointColours& result)
{
  for (std::size_t i = 0; i < frame.given.size(); ++i)
    result.colours[i] = apps::labelColour(frame.given[i]);
  result.legend = frame.given.empty() ? "colour: this file has no labels of its own"
                                      : "colour: label of the file, grey none";
}

void applySelection(const ViewFrame& frame, const SegmentedView& view,
                    const ViewSettings& settings, PointColours& result)
{
  // Towards the background, whichever it is.
  const double faded = settings.dark ? 0.0 : (1.0 - DIMMED) * 255.0;
  for (std::size_t i = 0; i < view.labels.size(); ++i) {
    const std::uint16_t label = view.labels[i];
    const bool is_selected = settings.selected != 0 && label == settings.selected;
    result.shown[i] = frame.points.valid[i] != 0 && settings.shows(label);
    if (settings.selected != 0 && !is_selected)
      for (std::uint8_t& channel : result.colours[i])
        channel = static_cast<std::uint8_t>(DIMMED * channel + faded);
  }
}

} // namespace

double ColourScale::shareOf(double value) const
{
  return logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low)
                     : (value - low) / (high - low);
}

io::Colour rampColour(double share)
{
  static constexpr std::array<io::Colour, 6> STOPS = {{{68, 1, 84},
                                                       {65, 68, 135},
                                                       {42, 120, 142},
                                                       {34, 168, 132},
                                                       {122, 209, 81},
                                                       {253, 231, 37}}};
  const double place = 5.0 * std::min(1.0, std::max(0.0, share));
  const auto below = std::min<std::size_t>(4, static_cast<std::size_t>(place));
  const double part = place - static_cast<double>(below);
  io::Colour colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = static_cast<std::uint8_t>(
        std::lround((1.0 - part) * STOPS[below][c] + part * STOPS[below + 1][c]));
  return colour;
}

PointColours colourPoints(const ViewFrame& frame, const SegmentedView& view,
                          const TileCells& tiles, const ViewSettings& settings,
                          const std::vector<std::uint32_t>& classes,
                          const std::optional<ColourScale>& same_scale)
{
  PointColours result;
  result.colours.assign(frame.points.size(), NO_VALUE);
  result.shown.assign(frame.points.size(), false);
  const bool has_own = !frame.colours.empty();
  if (settings.mode == ColourMode::PLANE)
    colourByPlane(view, classes, result);
  else if (settings.mode == ColourMode::OWN && has_own) {
    result.colours = frame.colours;
    result.legend = "colour: the cloud's own";
  }
  else if (settings.mode == ColourMode::OWN)
    result.legend = "colour: this cloud has none of its own";
  else if (settings.mode == ColourMode::GIVEN_LABEL)
    colourByGivenLabel(frame, result);
  else
    colourByValue(frame, view, tiles, settings.mode, same_scale, result);
  applySelection(frame, view, settings, result);
  return result;
}

} // namespace pcl_mrf_planes::viewer
