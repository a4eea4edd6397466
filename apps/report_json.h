// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_outputs.h"
#include "options.h"

#include <optional>
#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Write planes, counts, energies, parameters and, when they were asked for,
 * times as JSON, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do
 */
void writeReport(const std::string& path, const SegmentedFrame& segmented,
                 const Options& options);

/** \brief Numbers of a report that was written before. */
struct ReportedFrame {
  std::size_t planes = 0;
  std::size_t valid_points = 0;
  double labelled_share = 0.0;
  double ms = 0.0;
};

/** \brief What a report says, if it is of this input by this version with these
 * parameters; else nothing. */
std::optional<ReportedFrame>
readReport(const std::string& path, const std::string& input, const Options& options);

} // namespace pcl_mrf_planes::apps
