// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "report_json.h"

#include <ostream>
#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief What became of a frame. */
struct FrameOutcome {
  enum class Status { NOT_REACHED, DONE, RESUMED, FAILED };
  Status status = Status::NOT_REACHED;
  std::string name;
  std::string input;
  std::string reader;
  ReportedFrame numbers;
  std::string message; ///< why it failed
};

/** \brief Write one line for each frame as CSV, whole or not at all. */
void writeSummary(const std::string& path, const std::vector<FrameOutcome>& outcomes);

/** \brief How many frames came to what end, and the middle of their numbers. */
void printSummary(std::ostream& out, const std::vector<FrameOutcome>& outcomes,
                  double seconds);

/** \brief How many frames came to this end. */
std::size_t countOf(const std::vector<FrameOutcome>& outcomes,
                    FrameOutcome::Status status);

} // namespace pcl_mrf_planes::apps
