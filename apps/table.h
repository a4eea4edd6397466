// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_cloud.h"

#include <ostream>

namespace pcl_mrf_planes::apps {

/** \brief One line for each plane: number, points, area, rms and coefficients. */
void printPlanes(std::ostream& out, const SegmentedCloud& result);

/** \brief One line for each stage and one for the total, milliseconds. */
void printTiming(std::ostream& out, const Timing& timing);

/** \brief One line: how many planes on how many points, and what to try if none. */
void printSummary(std::ostream& out, const SegmentedCloud& result,
                  const Parameters& parameters);

} // namespace pcl_mrf_planes::apps
