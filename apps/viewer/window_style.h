// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkInteractorStyleTrackballCamera.h>

#include <functional>
#include <string>

namespace pcl_mrf_planes::viewer {

/** \brief VTK's trackball, with keys of our own and clicks told from drags. */
class WindowStyle : public vtkInteractorStyleTrackballCamera {
public:
  static WindowStyle* New();
  vtkTypeMacro(WindowStyle, vtkInteractorStyleTrackballCamera)

      void OnKeyPress() override;
  void OnChar() override {} ///< VTK's own keys would get in the way
  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;

  std::function<void(const std::string&)> press; ///< key as X names it
  std::function<void(int, int)> click;           ///< pixel from the bottom left

private:
  int start_[2] = {0, 0};
};

} // namespace pcl_mrf_planes::viewer
