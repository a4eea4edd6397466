// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "parameter_sliders.h"

#include <functional>
#include <memory>

class vtkRenderer;
class vtkRenderWindowInteractor;

namespace pcl_mrf_planes::viewer {

/** \brief The sliders of the parameters, one above the other at the left edge. */
class SliderPanel {
public:
  using Moved = std::function<void(std::size_t slider, double value)>;
  using Released = std::function<void()>;

  /** \param[in] renderer that they are drawn in, the whole window
   * \param[in] moved called while a slider is dragged; the window is drawn after it
   * \param[in] released called when it is let go */
  SliderPanel(vtkRenderWindowInteractor* interactor, vtkRenderer* renderer, Moved moved,
              Released released);
  ~SliderPanel();

  /** \brief Show the values of the parameters, or nothing. */
  void show(bool visible, const Parameters& parameters, bool dark);

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace pcl_mrf_planes::viewer
