// SPDX-License-Identifier: BSD-3-Clause
#include "screen.h"

#include "marks.h"
#include "output_file.h"

#include <pcl/visualization/pcl_visualizer.h>

#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRendererCollection.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr double DEGREES = 180.0 / 3.14159265358979323846;
constexpr double MARGIN = 1.08; // around what the sensor saw
constexpr int LAYERS = 4;
constexpr double PANEL_RIGHT = 0.985; // shares of the window
constexpr double PANEL_BOTTOM = 0.03;
constexpr double COLUMN_LEFT = 0.675;
constexpr double STRIP_LEFT = 0.42; // the text at the lower left ends before it
constexpr double RIM = 1.02;        // around the image

/// A layer is drawn over those below it, whatever their depth.
int layerOf(Screen::Part part)
{
  return part <= Screen::COLUMN        ? 0
         : part <= Screen::RIGHT_MARKS ? 1
         : part < Screen::OVERLAY      ? 2
                                       : 3;
}

} // namespace

Screen::Screen(int width, int height, bool off_screen)
: visualizer_(new pcl::visualization::PCLVisualizer("pcl_mrf_plane_viewer", false))
{
  window()->SetOffScreenRendering(off_screen ? 1 : 0);
  window()->SetSize(width, height);
  window()->SetMultiSamples(0);
  // PCL's own renderer would draw over the whole window.
  window()->GetRenderers()->RemoveAllItems();
  window()->SetNumberOfLayers(LAYERS);
  for (int part = 0; part < PARTS; ++part) {
    auto renderer = vtkSmartPointer<vtkRenderer>::New();
    renderer->SetLayer(layerOf(static_cast<Part>(part)));
    renderer->SetInteractive(part <= RIGHT ? 1 : 0);
    if (part == IMAGE || part == CHART) // plates of their own
      renderer->PreserveColorBufferOff();
    renderers_[static_cast<std::size_t>(part)] = renderer;
  }
  for (const Part part : {LEFT, LEFT_MARKS, OVERLAY})
    include(part, true);
  for (const Part part : {RIGHT, LEFT_MARKS, RIGHT_MARKS})
    renderers_[part]->SetActiveCamera(renderers_[LEFT]->GetActiveCamera());
  keepMarksApart(renderers_[LEFT_MARKS]);
  keepMarksApart(renderers_[RIGHT_MARKS]);
  renderers_[COLUMN]->SetViewport(COLUMN_LEFT - 0.01, 0.0, 1.0, 1.0);
  renderers_[CHART]->SetViewport(COLUMN_LEFT, 0.50, PANEL_RIGHT, 0.95);
  arrange({});
}

Screen::~Screen() = default;

vtkRenderWindow* Screen::window()
{
  return visualizer_->getRenderWindow();
}

void Screen::include(Part part, bool wanted)
{
  // A renderer that is in the window clears its part of it, even if it draws nothing.
  vtkRenderer* renderer = renderers_[part];
  const bool is_in = window()->HasRenderer(renderer) != 0;
  if (wanted && !is_in)
    window()->AddRenderer(renderer);
  else if (!wanted && is_in)
    window()->RemoveRenderer(renderer);
}

void Screen::show(Part part, const Props& props)
{
  vtkRenderer* renderer = renderers_[part];
  for (const auto& prop : shown_[part]) // the sliders' stay
    renderer->RemoveViewProp(prop);
  shown_[part] = props;
  for (const auto& prop : props)
    renderer->AddViewProp(prop);
  if (part == IMAGE || part == CHART)
    include(part, !props.empty());
  if (part == IMAGE && !props.empty())
    fitImage(props.front()->GetBounds());
}

void Screen::fitImage(const double* bounds)
{
  const double across = std::max(1.0, bounds[1] - bounds[0]);
  const double along = std::max(1.0, bounds[3] - bounds[2]);
  const double aspect = across / along;
  const bool is_in_column =
      belongsInColumn(static_cast<int>(across), static_cast<int>(along));
  const double widest = PANEL_RIGHT - (is_in_column ? COLUMN_LEFT : STRIP_LEFT);
  const double highest = !is_in_column || layout_.chart ? 0.42 : 0.94;
  const int* size = window()->GetSize();
  const double window_aspect = 1.0 * size[0] / std::max(1, size[1]);
  const double width = std::min(widest, highest * aspect / window_aspect);
  const double height = width * window_aspect / aspect;
  const double bottom =
      is_in_column && !layout_.chart ? 0.5 * (1.0 - height) : PANEL_BOTTOM;
  const double right =
      is_in_column ? PANEL_RIGHT - 0.5 * (widest - width) : PANEL_RIGHT;
  renderers_[IMAGE]->SetViewport(right - width, bottom, right, bottom + height);
  vtkCamera* camera = renderers_[IMAGE]->GetActiveCamera();
  camera->ParallelProjectionOn();
  renderers_[IMAGE]->ResetCamera();
  camera->SetParallelScale(0.5 * RIM * along);
}

bool Screen::belongsInColumn(int width, int height)
{
  return 2 * width <= 5 * height;
}

double Screen::viewEnd() const
{
  return layout_.column ? COLUMN_LEFT - 0.01 : 1.0;
}

void Screen::arrange(const Layout& layout)
{
  layout_ = layout;
  const double end = viewEnd();
  const double middle = layout.side_by_side ? 0.5 * end : end;
  for (const Part part : {LEFT, LEFT_MARKS})
    renderers_[part]->SetViewport(0.0, 0.0, middle, 1.0);
  for (const Part part : {RIGHT, RIGHT_MARKS}) {
    renderers_[part]->SetViewport(0.5 * end, 0.0, end, 1.0);
    include(part, layout.side_by_side);
  }
  include(COLUMN, layout.column);
  const double shade = layout.dark ? 0.08 : 1.0;
  for (const Part part : {LEFT, RIGHT, COLUMN})
    renderers_[part]->SetBackground(shade, shade, shade);
  const double plate = layout.dark ? 0.0 : 0.93;
  renderers_[IMAGE]->SetBackground(plate, plate, plate);
  renderers_[CHART]->SetBackground(plate, plate, plate);
  fitAngle();
}

void Screen::fitAngle()
{
  const int* size = window()->GetSize();
  const double share = viewEnd() * (layout_.side_by_side ? 0.5 : 1.0);
  const double aspect = share * size[0] / std::max(1.0, 1.0 * size[1]);
  const double tangent = MARGIN * std::max(view_.along, view_.across / aspect);
  renderers_[LEFT]->GetActiveCamera()->SetViewAngle(2.0 * DEGREES * std::atan(tangent));
}

void Screen::look(const SensorView& view)
{
  view_ = view;
  vtkCamera* camera = renderers_[LEFT]->GetActiveCamera();
  camera->SetPosition(view.position.data());
  camera->SetFocalPoint(view.focus.data());
  camera->SetViewUp(view.up.data());
  fitAngle();
  renderers_[LEFT]->ResetCameraClippingRange();
}

void writeWindow(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  grab->SetInputBufferTypeToRGB();
  apps::writeAtomically(path, [&](const std::string& temporary) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(grab->GetOutputPort());
    writer->SetFileName(temporary.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0)
      throw std::runtime_error("cannot write '" + path +
                               "' as PNG; check the folder and the space on the disk");
  });
}

} // namespace pcl_mrf_planes::viewer
