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

/** \brief What has a place in the window. */
struct Layout {
  bool side_by_side = false; ///< two views
  bool column = false;       ///< on the right, for image and chart
  bool chart = false;        ///< in the upper half of the column
  bool dark = true;          ///< behind the views
};

/** \brief The window's parts: two views with one camera, marks over each that nothing of the
 * scene hides, image panel, chart, and on top of all a layer for text and sliders. Owns the
 * PCLVisualizer. */
class Screen {
public:
  Screen(int width, int height, bool off_screen);
  ~Screen();

  enum Part {
    LEFT,
    RIGHT,
    COLUMN,
    LEFT_MARKS,
    RIGHT_MARKS,
    IMAGE,
    CHART,
    OVERLAY,
    PARTS
  };

  vtkRenderer* renderer(Part part) { return renderers_[part]; }
  vtkRenderWindow* window();

  /** \brief Replace what a part shows. */
  void show(Part part, const Props& props);

  /** \brief Place the parts; the angle of the views stays such that all fits. */
  void arrange(const Layout& layout);

  /** \brief Look from there. */
  void look(const SensorView& view);

  /** \brief Where the views end, and the column begins if there is one; in shares of the
   * width. */
  double viewEnd() const;

  /** \brief Whether an image of that shape has its place in the column; a strip lies across
   * the lower end of the view. */
  static bool belongsInColumn(int width, int height);

private:
  void include(Part part, bool wanted);
  void fitImage(const double* bounds);
  void fitAngle();

  pcl::shared_ptr<pcl::visualization::PCLVisualizer> visualizer_;
  std::array<vtkSmartPointer<vtkRenderer>, PARTS> renderers_;
  std::array<Props, PARTS> shown_;
  Layout layout_;
  SensorView view_;
};

/** \brief The pixels of a window as a PNG, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeWindow(vtkRenderWindow* window, const std::string& path);

} // namespace pcl_mrf_planes::viewer
