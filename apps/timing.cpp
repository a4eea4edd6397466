// SPDX-License-Identifier: BSD-3-Clause
#include "timing.h"

#include <algorithm>

namespace pcl_mrf_planes::apps {

Spread spreadOf(std::vector<double> measurements)
{
  if (measurements.empty())
    return {};
  std::sort(measurements.begin(), measurements.end());
  const std::size_t middle = measurements.size() / 2;
  const double median = measurements.size() % 2 == 1
                            ? measurements[middle]
                            : (measurements[middle - 1] + measurements[middle]) / 2.0;
  return {median, measurements.front(), measurements.back()};
}

void Timing::add(const std::vector<std::pair<std::string, double>>& stage_ms)
{
  double total = 0.0;
  for (const auto& stage : stage_ms) {
    total += stage.second;
    const auto known =
        std::find_if(stages_.begin(), stages_.end(),
                     [&](const auto& entry) { return entry.first == stage.first; });
    if (known == stages_.end())
      stages_.push_back({stage.first, {stage.second}});
    else
      known->second.push_back(stage.second);
  }
  totals_.push_back(total);
}

std::vector<std::pair<std::string, Spread>> Timing::stages() const
{
  std::vector<std::pair<std::string, Spread>> result;
  for (const auto& stage : stages_)
    result.emplace_back(stage.first, spreadOf(stage.second));
  return result;
}

} // namespace pcl_mrf_planes::apps
