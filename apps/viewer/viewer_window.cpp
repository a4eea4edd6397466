// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_window.h"

#include "pick_point.h"
#include "screen.h"
#include "session_picture.h"
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
using Clock = std::chrono::steady_clock;

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
  SessionPicture picture;
  vtkSmartPointer<vtkRenderWindowInteractor> interactor;
  vtkNew<WindowStyle> style;
  std::unique_ptr<SliderPanel> sliders;
  Clock::time_point last = Clock::now();
  int pictures = 0;
  double full_seconds = 0.0; ///< that drawing all points took last
  bool done = false;

  Parts(Session& s, const WindowOptions& o)
  : session(s)
  , options(o)
  , screen(o.width, o.height, o.off_screen)
  , picture(s, screen)
  , interactor(makeInteractor(screen.window(), o.off_screen))
  {}

  void prepare(bool coarse);
  void draw();
  void act(Action action);
  void click(int x, int y);
  void tick();
  void log() const;
};

void ViewerWindow::Parts::prepare(bool coarse)
{
  picture.compose(coarse);
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
  if (picture.isFull())
    full_seconds = std::chrono::duration<double>(Clock::now() - before).count();
}

void ViewerWindow::Parts::act(Action action)
{
  session.perform(action);
  if (action == Action::COMPARE || action == Action::RESET_CAMERA)
    picture.lookFromSensor();
  if (action == Action::FACE_PLANE)
    picture.facePlane();
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
  session.pick(pickPoint(*picture.shownCloud(), picture.shownPoints(), projection,
                         place, 2.0 * PICK_REACH * extent.cwiseInverse()));
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
  parts.picture.lookFromSensor();
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
