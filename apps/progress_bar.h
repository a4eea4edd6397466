// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pcl_mrf_planes::apps {

/** \brief A line on the terminal with what is done, the rate and the time left; nothing
 * where standard error is no terminal. Not for several threads at once. */
class ProgressBar {
public:
  /** \param[in] total frames to do
   * \param[in] shown whether to print at all */
  ProgressBar(std::size_t total, bool shown);
  /** \brief Takes the line away. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /** \brief One more frame is done. */
  void advance();

  /** \brief Print a line above the bar, on standard error. */
  void say(const std::string& line);

private:
  void draw() const;
  void clear() const;

  std::size_t total_;
  std::size_t done_ = 0;
  bool shown_;
  std::chrono::steady_clock::time_point start_;
};

/** \brief The line: bar, frames done, frames a second, time left. */
std::string progressLine(std::size_t done, std::size_t total, double seconds);

} // namespace pcl_mrf_planes::apps
