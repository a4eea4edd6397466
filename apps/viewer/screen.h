// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "layers.h"
#include "sensor_view.h"

#include <pcl/memory.h>

#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <array>
#include <string>

namespace pcl::visualization {
class PCLVisualizer;
}

namespace pcl_mrf_planes::viewer {

/** \brief The window's parts: two views with one camera, marks over each that nothing of the
 * scene hides, image panel, chart, and on top of all a layer for text and sliders. Owns the
 * PCLVisualizer. */
class Screen {
public:
  Screen(int width, int height, bool off_screen);
  ~Screen();

  enum Part { LEFT, RIGHT, LEFT_MARKS, RIGHT_MARKS, IMAGE, CHART, OVERLAY, PARTS };

  vtkRenderer* renderer(Part part) { return renderers_[part]; }
  vtkRenderWindow* window();

  /** \brief Replace what a part shows. */
  void show(Part part, const Props& props);

  /** \brief Whether two views stand side by side, and the colour behind them. */
  void arrange(bool side_by_side, bool dark);

  /** \brief Look from there; the angle is such that all fits. */
  void look(const SensorView& view);

private:
  void include(Part part, bool wanted);
  void fitImage(const double* bounds);

  pcl::shared_ptr<pcl::visualization::PCLVisualizer> visualizer_;
  std::array<vtkSmartPointer<vtkRenderer>, PARTS> renderers_;
  std::array<Props, PARTS> shown_;
  bool side_by_side_ = false;
};

/** \brief The pixels of a window as a PNG, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeWindow(vtkRenderWindow* window, const std::string& path);

} // namespace pcl_mrf_planes::viewer
