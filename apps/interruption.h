// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl_mrf_planes::apps {

/** \brief What Ctrl-C does from here on: no half file is left in any case. */
enum class OnInterruption {
  END,   ///< end at once
  FINISH ///< the first time finish the frames at work, the second time end at once
};

/** \brief Take SIGINT and SIGTERM. */
void takeInterruptions(OnInterruption what);

/** \brief Whether one came. */
bool interrupted();

} // namespace pcl_mrf_planes::apps
