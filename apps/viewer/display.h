// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl_mrf_planes::viewer {

/** \brief Whether an X server answers; VTK would end the program where none does. */
bool hasDisplay();

/** \brief Start this program again under xvfb-run, with the same words; returns only if
 * there is none. */
void restartUnderXvfb(char* argv[]);

} // namespace pcl_mrf_planes::viewer
