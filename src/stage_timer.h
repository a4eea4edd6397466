// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_segmentation.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {

/// A report of nothing yet, in the memory of the one before.
inline void startAnew(SegmentationReport& report)
{
  SegmentationReport anew;
  std::swap(anew.energy, report.energy);
  std::swap(anew.stage_ms, report.stage_ms);
  anew.energy.clear();
  anew.stage_ms.clear();
  report = std::move(anew);
}

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
