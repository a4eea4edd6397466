// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

namespace pcl_mrf_planes::viewer {

/** \brief Whether an X server answers; VTK would end the program where none does. */
bool hasDisplay();

/** \brief An X server without a screen, Xvfb, that lives as long as this object and is this
 * program's display meanwhile. */
class VirtualDisplay {
public:
  VirtualDisplay() = default;
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;
  ~VirtualDisplay();

  /** \return whether it answers; false where there is no Xvfb */
  bool start();

private:
  pid_t server_ = -1;
};

} // namespace pcl_mrf_planes::viewer
