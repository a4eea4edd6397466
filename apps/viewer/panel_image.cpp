// SPDX-License-Identifier: BSD-3-Clause
#include "panel_image.h"

#include "label_colours.h"
#include "pictures.h"
#include "point_colours.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double LABEL_SHARE = 0.6; // of a label's colour over the picture below

double farthest(const OrganizedPoints& points)
{
  double depth = 1e-6;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      depth = std::max(depth, static_cast<double>(points.depth(i)));
  return depth;
}

/// Brightness of the picture below, 0 to 1: its own hues would pass for labels.
double brightness(const ViewFrame& frame, std::size_t i, bool by_colour, double far)
{
  if (by_colour) {
    const io::Colour& c = frame.colours[i];
    return (0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]) / 255.0;
  }
  return 1.0 - 0.85 * static_cast<double>(frame.points.depth(i)) / far;
}

io::ColourImage colourAndDepth(const ViewFrame& frame)
{
  const OrganizedPoints& points = frame.points;
  io::ColourImage image(points.width, 2 * points.height);
  const apps::Picture colour = apps::sight(points, frame.colours);
  std::copy(colour.pixels.begin(), colour.pixels.end(), image.pixels.begin());
  ViewSettings by_depth;
  by_depth.mode = ColourMode::DEPTH;
  SegmentedView no_planes;
  no_planes.labels.assign(points.size(), 0);
  const PointColours depth = colourPoints(frame, no_planes, {}, by_depth, {});
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      image.pixels[points.size() + i] = depth.colours[i];
  return image;
}

} // namespace

io::ColourImage panelImage(const ViewFrame& frame, const SegmentedView& view,
                           Panel panel, const std::vector<std::uint32_t>& classes)
{
  if (panel == Panel::COLOUR_AND_DEPTH)
    return colourAndDepth(frame);
  const bool by_colour = panel == Panel::LABELS_ON_COLOUR && !frame.colours.empty();
  const double far = farthest(frame.points);
  io::ColourImage image(frame.points.width, frame.points.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (frame.points.valid[i] == 0)
      continue;
    const double below = 255.0 * brightness(frame, i, by_colour, far);
    const std::uint16_t label = view.labels[i];
    const io::Colour above = apps::labelColour(
        label != 0 && label <= classes.size() ? classes[label - 1u] : label);
    const double share = label == 0 ? 0.0 : LABEL_SHARE;
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][c] = static_cast<std::uint8_t>(
          std::lround((1.0 - share) * below + share * above[c]));
  }
  return image;
}

} // namespace pcl_mrf_planes::viewer
