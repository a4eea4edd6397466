// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "options.h"
#include "segmented_cloud.h"

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Write planes, counts, energies, parameters and, when they were asked for,
 * times as JSON, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do
 */
void writeReport(const std::string& path, const SegmentedCloud& result,
                 const Options& options);

} // namespace pcl_mrf_planes::apps
