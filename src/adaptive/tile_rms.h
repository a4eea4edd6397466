// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/noise_estimation.h"
#include "frame_memory.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Level whose tiles the noise is read from.
constexpr std::size_t BASE = 1;

/// The number that such a share of them is below; 0 of none. Orders the numbers as it needs.
inline double percentile(FrameVector<double>& v, double p)
{
  if (v.empty())
    return 0;
  const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), v.begin() + k, v.end());
  return v[static_cast<std::size_t>(k)];
}

/// Mean square distance with the three fitted parameters taken out, as if seen from the
/// front.
inline double unbiasedVariance(const FittedPlane& p)
{
  return p.mse * p.n / ((p.n - 3) * incidenceFactor(p));
}

inline double unbiasedRms(const FittedPlane& p)
{
  return std::sqrt(unbiasedVariance(p));
}

} // namespace pcl_mrf_planes::adaptive
