// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"

namespace pcl_mrf_planes::apps {

/** \brief Segment all frames of all inputs, several at a time, and sum up.
 *
 * A frame that fails is reported on standard error and left out; the others go on.
 *
 * \return exit status: 0, 3 when frames failed, 130 when interrupted
 * \throws std::runtime_error when there is nothing to do or nowhere to write
 */
int runBatch(const Options& options);

} // namespace pcl_mrf_planes::apps
