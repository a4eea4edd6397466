// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/random.h"

namespace pcl_mrf_planes::scenes {

double Random::uniform()
{
  return static_cast<double>(engine_() >> 11) * 0x1.0p-53;
}

int Random::integer(int low, int high)
{
  return low + static_cast<int>(uniform() * (high - low + 1));
}

double Random::normal()
{
  // Three 21-bit uniforms from each 64-bit draw: enough resolution, a third of the
  // cost.
  constexpr std::uint64_t MASK = (std::uint64_t{1} << 21) - 1;
  std::uint64_t sum = 0;
  for (int draw = 0; draw < 4; ++draw) {
    const std::uint64_t bits = engine_();
    sum += (bits & MASK) + ((bits >> 21) & MASK) + ((bits >> 42) & MASK);
  }
  return static_cast<double>(sum) * 0x1.0p-21 - 6.0;
}

} // namespace pcl_mrf_planes::scenes
