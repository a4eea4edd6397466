// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_window.h"

#include "label_contours.h"
#include "panel_image.h"
#include "pick_point.h"
#include "screen.h"
#include "slider_panel.h"
#include "view_text.h"
#include "window_style.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr std::chrono::milliseconds TICK(4); // between looks for events
constexpr double DRAG_SECONDS = 0.03; // that drawing may take while a slider is dragged
constexpr double PICK_REACH = 4.0;    // pixels
constexpr const char* MOUSE_HELP =
    "mouse  left turns, a click picks a point, middle moves, wheel zooms";
using Clock = std::chrono::steady_clock;

void append(const Props& more, Props& props)
{
  props.insert(props.end(), more.begin(), more.end());
}

vtkSmartPointer<vtkRenderWindowInteractor> makeInteractor(vtkRenderWindow* window,
                                                          bool off_screen)
{
  vtkSmartPointer<vtkRenderWindowInteractor> interactor;
  if (off_screen) // no events, but what sliders are attached to
    interactor = vtkSmartPointer<vtkGenericRenderWindowInteractor>::New();
  else
    interactor = vtkSmartPointer<vtkRenderWindowInteractor>::New();
  interactor->SetRenderWindow(window);
  return interactor;
}

} // namespace

struct ViewerWindow::Parts {
  Session& session;
  WindowOptions options;
  Screen screen;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor;
  vtkNew<WindowStyle> style;
  std::unique_ptr<SliderPanel> sliders;
  PointColours left;
  Clock::time_point last = Clock::now();
  int pictures = 0;
  double full_seconds = 0.0; ///< that drawing all points took last
  int stride = 1;            ///< of the points that are drawn
  bool done = false;

  Parts(Session& s, const WindowOptions& o)
  : session(s)
  , options(o)
  , screen(o.width, o.height, o.off_screen)
  , interactor(makeInteractor(screen.window(), o.off_screen))
  {}

  Props view(const SegmentedView& result, const std::vector<std::uint32_t>& classes,
             const ViewSettings& settings, PointColours& colours) const;
  static Props marks(const SegmentedView& result, const ViewSettings& settings);
  Layout layout() const;
  static SegmentedView stageOf(const FilmStep& step);
  void drawLeft();
  void drawRight();
  void drawPanels();
  Props texts() const;
  void prepare(bool coarse);
  void draw();
  void act(Action action);
  void click(int x, int y);
  void tick();
  void log() const;
};

Props ViewerWindow::Parts::view(const SegmentedView& result,
                                const std::vector<std::uint32_t>& classes,
                                const ViewSettings& settings,
                                PointColours& colours) const
{
  const ViewFrame& frame = session.frame();
  colours =
      colourPoints(frame, result, session.tiles(), settings, classes, colours.scale);
  Props props = {cloudLayer(frame, colours, stride)};
  if (settings.contours)
    props.push_back(contourLayer(frame, contoursOf(frame, result), settings));
  if (settings.normals)
    props.push_back(normalLayer(result, settings));
  if (settings.creases && result.creases)
    append(creaseLayer(result.creases(), settings), props);
  return props;
}

Props ViewerWindow::Parts::marks(const SegmentedView& result,
                                 const ViewSettings& settings)
{
  Props props;
  if (settings.normals)
    append(numberMarks(result, settings), props);
  if (settings.creases && result.creases)
    append(angleMarks(result.creases(), settings), props);
  return props;
}

Layout ViewerWindow::Parts::layout() const
{
  const OrganizedPoints& points = session.frame().points;
  Layout layout;
  layout.side_by_side = session.compares();
  layout.chart = session.filmStep() != nullptr && !session.film().energy.empty();
  layout.column =
      layout.chart || (session.settings.panel != Panel::OFF &&
                       Screen::belongsInColumn(points.width, points.height));
  layout.dark = session.settings.dark;
  return layout;
}

SegmentedView ViewerWindow::Parts::stageOf(const FilmStep& step)
{
  SegmentedView stage;
  stage.labels = step.labels;
  stage.planes.resize(step.classes.size());
  return stage;
}

void ViewerWindow::Parts::drawLeft()
{
  left.scale.reset();
  ViewSettings settings = session.settings;
  if (const FilmStep* step = session.filmStep()) {
    const SegmentedView stage = stageOf(*step);
    settings.mode = ColourMode::PLANE;
    settings.normals = settings.isolate = false;
    settings.selected = 0;
    settings.hidden.clear();
    screen.show(Screen::LEFT, view(stage, step->classes, settings, left));
    screen.show(Screen::LEFT_MARKS, {});
    return;
  }
  Props props = view(session.main(), session.mainColours(), settings, left);
  if (settings.tiles) {
    // Dim points between the tiles, in the place of bright ones.
    PointColours dim = left;
    for (io::Colour& colour : dim.colours)
      for (std::uint8_t& channel : colour)
        channel = static_cast<std::uint8_t>(channel / 3);
    props[0] = cloudLayer(session.frame(), dim, stride);
    append(tileLayer(session.frame(), session.tiles()), props);
  }
  screen.show(Screen::LEFT, props);
  screen.show(Screen::LEFT_MARKS, marks(session.main(), settings));
}

void ViewerWindow::Parts::drawRight()
{
  if (!session.compares()) {
    screen.show(Screen::RIGHT, {});
    screen.show(Screen::RIGHT_MARKS, {});
    return;
  }
  ViewSettings settings = session.settings; // planes are picked on the left
  settings.selected = 0;
  settings.isolate = false;
  settings.hidden.clear();
  PointColours colours;
  colours.scale = left.scale; // what is compared has one scale
  screen.show(Screen::RIGHT,
              view(session.other(), session.otherColours(), settings, colours));
  screen.show(Screen::RIGHT_MARKS, marks(session.other(), settings));
}

void ViewerWindow::Parts::drawPanels()
{
  const ViewSettings& settings = session.settings;
  Props image, chart;
  const FilmStep* step = session.filmStep();
  if (settings.panel != Panel::OFF)
    image.push_back(imageLayer(
        panelImage(session.frame(), step ? stageOf(*step) : session.main(),
                   settings.panel, step ? step->classes : session.mainColours())));
  if (step != nullptr && !session.film().energy.empty()) {
    // The curve grows with the film; after the last iteration it stays whole.
    int shown = -1;
    for (int k = 0; k <= settings.film_step; ++k)
      shown =
          std::max(shown, session.film().steps[static_cast<std::size_t>(k)].iteration);
    if (shown >= 0) // VTK draws no axes without a curve
      chart.push_back(energyLayer(session.film().energy, shown, settings.dark));
  }
  screen.show(Screen::IMAGE, image);
  screen.show(Screen::CHART, chart);
}

Props ViewerWindow::Parts::texts() const
{
  const ViewSettings& settings = session.settings;
  const bool dark = settings.dark;
  if (settings.help)
    return {textLayer(keyHelp() + MOUSE_HELP, 0.30, 0.98, true, dark, 14)};
  Props props;
  if (settings.facts) {
    props.push_back(textLayer(factsText(session), 0.01, 0.985, true, dark));
    if (session.compares())
      props.push_back(textLayer(comparisonText(session), 0.5 * screen.viewEnd() + 0.01,
                                0.985, true, dark));
  }
  if (left.scale && session.filmStep() == nullptr)
    props.push_back(scaleLayer(*left.scale, screen.viewEnd(), dark));
  std::string below = selectionText(session);
  if (settings.facts && session.filmStep() == nullptr)
    below += left.legend + '\n';
  below += session.message();
  if (!below.empty())
    // Sliders reach down to where it would stand.
    props.push_back(
        textLayer(below, settings.sliders ? 0.29 : 0.01, 0.015, false, dark));
  return props;
}

void ViewerWindow::Parts::prepare(bool coarse)
{
  stride = coarse ? 2 : 1;
  screen.arrange(layout());
  drawLeft();
  drawRight();
  drawPanels();
  screen.show(Screen::OVERLAY, texts());
  if (sliders)
    sliders->show(session.settings.sliders && !session.settings.help,
                  session.parameters(), session.settings.dark);
  screen.renderer(Screen::LEFT)->ResetCameraClippingRange();
}

void ViewerWindow::Parts::draw()
{
  // Drawing by software would hold up a sequence: a quarter of the points until it rests.
  prepare(session.playing() && full_seconds > 0.5 / session.speed());
  const Clock::time_point before = Clock::now();
  screen.window()->Render();
  if (stride == 1)
    full_seconds = std::chrono::duration<double>(Clock::now() - before).count();
}

void ViewerWindow::Parts::act(Action action)
{
  session.perform(action);
  if (action == Action::COMPARE || action == Action::RESET_CAMERA) {
    screen.arrange(layout());
    screen.look(sensorView(session.frame()));
  }
  if (action == Action::SCREENSHOT) {
    const std::string path =
        options.pictures + '_' + std::to_string(++pictures) + ".png";
    try {
      writeWindow(screen.window(), path);
      session.say("picture in " + path);
    }
    catch (const std::exception& error) {
      session.say(error.what());
    }
  }
  draw();
  log();
  if (action == Action::QUIT)
    done = true;
}

void ViewerWindow::Parts::click(int x, int y)
{
  vtkRenderer* renderer = screen.renderer(Screen::LEFT);
  if (renderer->IsInViewport(x, y) == 0)
    return;
  const int* size = renderer->GetSize();
  const int* origin = renderer->GetOrigin();
  const double aspect = 1.0 * size[0] / std::max(1, size[1]);
  vtkMatrix4x4* matrix =
      renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(aspect, -1.0,
                                                                         1.0);
  const Eigen::Matrix4d projection =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(matrix->GetData());
  const Eigen::Vector2d extent(size[0], size[1]);
  const Eigen::Vector2d place =
      2.0 * (Eigen::Vector2d(x - origin[0], y - origin[1]).array() / extent.array()) -
      1.0;
  session.pick(pickPoint(*session.frame().cloud, left.shown, projection, place,
                         2.0 * PICK_REACH * extent.cwiseInverse()));
  draw();
  log();
}

void ViewerWindow::Parts::tick()
{
  const Clock::time_point now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - last).count();
  last = now;
  if (!session.advance(seconds))
    return;
  draw();
  log();
}

void ViewerWindow::Parts::log() const
{
  if (options.log)
    std::cout << stateLine(session) << std::endl;
}

ViewerWindow::ViewerWindow(Session& session, const WindowOptions& options)
: parts_(new Parts(session, options))
{
  Parts& parts = *parts_;
  parts.style->click = [&parts](int x, int y) { parts.click(x, y); };
  parts.style->press = [&parts](const std::string& key) {
    if (const auto action = actionOfKey(key))
      parts.act(*action);
  };
  parts.interactor->SetInteractorStyle(parts.style);
  parts.interactor->Initialize();
  parts.sliders = std::make_unique<SliderPanel>(
      parts.interactor, parts.screen.renderer(Screen::OVERLAY),
      [&parts](std::size_t slider, double value) {
        parts.session.useSlider(slider, value);
        parts.prepare(parts.full_seconds > DRAG_SECONDS);
        parts.log();
      },
      [&parts] { parts.draw(); });
  parts.screen.look(sensorView(session.frame()));
  draw();
}

ViewerWindow::~ViewerWindow()
{
  // What hangs on the X server goes while all of it is there: the interactor looks for
  // the window's display when it ends.
  parts_->sliders.reset();
  parts_->screen.window()->Finalize();
  parts_->interactor->SetRenderWindow(nullptr);
}

bool ViewerWindow::press(const std::string& key)
{
  const auto action = actionOfKey(key);
  if (action)
    parts_->act(*action);
  return action.has_value();
}

void ViewerWindow::draw()
{
  parts_->draw();
}

void ViewerWindow::writePicture(const std::string& path)
{
  writeWindow(parts_->screen.window(), path);
}

void ViewerWindow::run()
{
  // A loop of our own, as PCLVisualizer has: VTK's ends with a fault when a key ends it.
  Parts& parts = *parts_;
  vtkNew<vtkCallbackCommand> closed;
  closed->SetClientData(&parts);
  closed->SetCallback([](vtkObject*, unsigned long, void* data, void*) {
    static_cast<Parts*>(data)->done = true;
  });
  parts.interactor->AddObserver(vtkCommand::ExitEvent, closed);
  parts.last = Clock::now();
  parts.log();
  while (!parts.done) {
    parts.interactor->ProcessEvents();
    parts.tick();
    std::this_thread::sleep_for(TICK);
  }
}

} // namespace pcl_mrf_planes::viewer
