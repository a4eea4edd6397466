// SPDX-License-Identifier: BSD-3-Clause
#include "window_style.h"

#include <vtkObjectFactory.h>
#include <vtkRenderWindowInteractor.h>

#include <cstdlib>

namespace pcl_mrf_planes::viewer {

namespace {

constexpr int STILL = 3; // pixels that a click may move

} // namespace

vtkStandardNewMacro(WindowStyle);

void WindowStyle::OnKeyPress()
{
  const char* key = Interactor->GetKeySym();
  if (key != nullptr && press)
    press(key);
}

void WindowStyle::OnLeftButtonDown()
{
  Interactor->GetEventPosition(start_);
  vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
}

void WindowStyle::OnLeftButtonUp()
{
  vtkInteractorStyleTrackballCamera::OnLeftButtonUp();
  int end[2];
  Interactor->GetEventPosition(end);
  if (click && std::abs(end[0] - start_[0]) <= STILL &&
      std::abs(end[1] - start_[1]) <= STILL)
    click(end[0], end[1]);
}

} // namespace pcl_mrf_planes::viewer
