// SPDX-License-Identifier: BSD-3-Clause
#include "session_picture.h"

#include "label_contours.h"
#include "panel_image.h"
#include "view_text.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr const char* MOUSE_HELP =
    "mouse  left turns, a click picks a point, middle moves, wheel zooms";

void append(const Props& more, Props& props)
{
  props.insert(props.end(), more.begin(), more.end());
}

Props marks(const SegmentedView& result, const ViewSettings& settings)
{
  Props props;
  if (settings.normals)
    append(numberMarks(result, settings), props);
  if (settings.creases && result.creases)
    append(angleMarks(result.creases(), settings), props);
  return props;
}

SegmentedView stageOf(const FilmStep& step)
{
  SegmentedView stage;
  stage.labels = step.labels;
  stage.planes.resize(step.classes.size());
  return stage;
}

/// As large as the window lets all lines of it be.
vtkSmartPointer<vtkProp> helpText(int window_height, bool dark)
{
  constexpr int LARGEST = 14;
  constexpr int SMALLEST = 6;
  constexpr double LINE = 1.13; // height over font size
  const std::string text = keyHelp() + MOUSE_HELP;
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  const int size =
      static_cast<int>(0.97 * window_height / (LINE * static_cast<double>(lines)));
  return textLayer(text, 0.30, 0.985, true, dark,
                   std::max(SMALLEST, std::min(LARGEST, size)));
}

/// Text takes no more of a small window than of a large one, as long as it can be read.
int textSize(int window_height)
{
  constexpr int LARGEST = 15;
  constexpr int SMALLEST = 11;
  return std::max(SMALLEST, std::min(LARGEST, window_height / 40));
}

} // namespace

Props SessionPicture::view(const SegmentedView& result,
                           const std::vector<std::uint32_t>& classes,
                           const ViewSettings& settings, PointColours& colours) const
{
  const ViewFrame& frame = session_.frame();
  colours =
      colourPoints(frame, result, session_.tiles(), settings, classes, colours.scale);
  const Cloud& cloud = *cloudOf(result);
  Props props = {cloudLayer(cloud, colours, pointSize(), stride_)};
  if (settings.contours)
    props.push_back(contourLayer(cloud, contoursOf(frame, result), settings));
  if (settings.normals)
    props.push_back(normalLayer(result, settings));
  if (settings.creases && result.creases)
    append(creaseLayer(result.creases(), settings), props);
  if (settings.shapes != Shapes::OFF && result.outlines)
    append(shapeLayer(result.outlines(), classes, settings), props);
  return props;
}

Cloud::ConstPtr SessionPicture::cloudOf(const SegmentedView& result) const
{
  if (session_.settings.projected && result.projected)
    return result.projected();
  return session_.frame().cloud;
}

float SessionPicture::pointSize() const
{
  constexpr double COVER =
      1.4; // of the way to the next point: nothing shows between them
  constexpr double SMALLEST = 3.0;
  constexpr double LARGEST = 9.0;
  const OrganizedPoints& points = session_.frame().points;
  const int* size = screen_.renderer(Screen::LEFT)->GetSize();
  const double spacing =
      std::min(1.0 * size[0] / points.width, 1.0 * size[1] / points.height);
  const double wanted = std::round(COVER * spacing * stride_);
  return static_cast<float>(std::max(SMALLEST, std::min(LARGEST, wanted)));
}

Layout SessionPicture::layout() const
{
  const OrganizedPoints& points = session_.frame().points;
  Layout layout;
  layout.side_by_side = session_.compares();
  layout.chart = session_.filmStep() != nullptr && !session_.film().energy.empty();
  layout.column =
      layout.chart || (session_.settings.panel != Panel::OFF &&
                       Screen::belongsInColumn(points.width, points.height));
  layout.dark = session_.settings.dark;
  return layout;
}

void SessionPicture::drawLeft()
{
  left_.scale.reset();
  ViewSettings settings = session_.settings;
  if (const FilmStep* step = session_.filmStep()) {
    const SegmentedView stage = stageOf(*step);
    settings.mode = ColourMode::PLANE;
    settings.normals = settings.isolate = false;
    settings.selected = 0;
    settings.hidden.clear();
    screen_.show(Screen::LEFT, view(stage, step->classes, settings, left_));
    screen_.show(Screen::LEFT_MARKS, {});
    return;
  }
  Props props = view(session_.main(), session_.mainColours(), settings, left_);
  if (settings.tiles) {
    // Dim points between the tiles, in the place of bright ones.
    PointColours dim = left_;
    for (io::Colour& colour : dim.colours)
      for (std::uint8_t& channel : colour)
        channel = static_cast<std::uint8_t>(channel / 3);
    props[0] = cloudLayer(*cloudOf(session_.main()), dim, pointSize(), stride_);
    append(tileLayer(session_.frame(), session_.tiles()), props);
  }
  screen_.show(Screen::LEFT, props);
  screen_.show(Screen::LEFT_MARKS, marks(session_.main(), settings));
}

void SessionPicture::drawRight()
{
  if (!session_.compares()) {
    screen_.show(Screen::RIGHT, {});
    screen_.show(Screen::RIGHT_MARKS, {});
    return;
  }
  ViewSettings settings = session_.settings; // planes are picked on the left
  settings.selected = 0;
  settings.isolate = false;
  settings.hidden.clear();
  PointColours colours;
  colours.scale = left_.scale; // what is compared has one scale
  screen_.show(Screen::RIGHT,
               view(session_.other(), session_.otherColours(), settings, colours));
  screen_.show(Screen::RIGHT_MARKS, marks(session_.other(), settings));
}

void SessionPicture::drawPanels()
{
  const ViewSettings& settings = session_.settings;
  Props image, chart;
  const FilmStep* step = session_.filmStep();
  if (settings.panel != Panel::OFF)
    image.push_back(imageLayer(
        panelImage(session_.frame(), step ? stageOf(*step) : session_.main(),
                   settings.panel, step ? step->classes : session_.mainColours())));
  if (step != nullptr && !session_.film().energy.empty()) {
    // The curve grows with the film; after the last iteration it stays whole.
    int shown = -1;
    for (int k = 0; k <= settings.film_step; ++k)
      shown =
          std::max(shown, session_.film().steps[static_cast<std::size_t>(k)].iteration);
    if (shown >= 0) // VTK draws no axes without a curve
      chart.push_back(energyLayer(session_.film().energy, shown, settings.dark));
  }
  screen_.show(Screen::IMAGE, image);
  screen_.show(Screen::CHART, chart);
}

Props SessionPicture::texts() const
{
  const ViewSettings& settings = session_.settings;
  const bool dark = settings.dark;
  const int height = screen_.window()->GetSize()[1];
  const auto text = [&](const std::string& lines, double x, double y, bool from_top) {
    return textLayer(lines, x, y, from_top, dark, textSize(height));
  };
  if (settings.help)
    return {helpText(height, dark)};
  Props props;
  if (settings.facts) {
    props.push_back(text(factsText(session_), 0.01, 0.985, true));
    if (session_.compares())
      props.push_back(
          text(comparisonText(session_), 0.5 * screen_.viewEnd() + 0.01, 0.985, true));
  }
  if (left_.scale && session_.filmStep() == nullptr)
    append(scaleLayer(*left_.scale, screen_.viewEnd(), dark), props);
  std::string below = selectionText(session_);
  // A scale is nothing without its quantity.
  if ((settings.facts || left_.scale) && session_.filmStep() == nullptr)
    below += left_.legend + '\n';
  below += session_.message();
  if (!below.empty())
    // Sliders reach down to where it would stand.
    props.push_back(text(below, settings.sliders ? 0.29 : 0.01, 0.015, false));
  return props;
}

void SessionPicture::compose(bool coarse)
{
  stride_ = coarse ? 2 : 1;
  screen_.arrange(layout());
  drawLeft();
  drawRight();
  drawPanels();
  screen_.show(Screen::OVERLAY, texts());
}

void SessionPicture::lookFromSensor()
{
  screen_.arrange(layout());
  screen_.look(sensorView(session_.frame()));
}

void SessionPicture::facePlane()
{
  const std::size_t selected = session_.settings.selected;
  screen_.look(selected == 0 ? viewFromAbove(session_.frame())
                             : viewAlong(session_.frame(),
                                         session_.main().planes[selected - 1u].normal));
}

} // namespace pcl_mrf_planes::viewer
