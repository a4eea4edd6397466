// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief The middle value, the upper one of two; there must be one. */
inline float medianOf(std::vector<float> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** \brief Three deviations to both sides of the median. */
struct RobustRange {
  float low = 0.0f, high = 0.0f;
};

/** \brief Median and median absolute deviation, scaled to the standard deviation of a
 * normal distribution; there must be a value. */
inline RobustRange robustRange(std::vector<float> values)
{
  const float median = medianOf(values);
  for (float& value : values)
    value = std::abs(value - median);
  const float reach = 3.0f * 1.4826f * medianOf(std::move(values));
  return {median - reach, median + reach};
}

} // namespace pcl_mrf_planes::benchmarks
