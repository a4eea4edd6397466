// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {

/// Writes down how long each stage took, one after the other.
class StageTimer {
public:
  using Clock = std::chrono::steady_clock;

  explicit StageTimer(std::vector<std::pair<std::string, double>>& stages)
  : stages_(stages)
  , start_(Clock::now())
  {}

  /// The stage that ends now began where the last one ended; a stage that comes again
  /// adds to its time.
  void finish(const char* stage)
  {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    for (auto& known : stages_)
      if (known.first == stage) {
        known.second += ms;
        return;
      }
    stages_.emplace_back(stage, ms);
  }

private:
  std::vector<std::pair<std::string, double>>& stages_;
  Clock::time_point start_;
};

} // namespace pcl_mrf_planes
