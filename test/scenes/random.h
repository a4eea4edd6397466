// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace pcl_mrf_planes::scenes {

/** \brief Random numbers that are the same on every platform.
 *
 * std::mt19937_64 is fixed by the standard, the distributions of \<random\> are not, so
 * the conversions are done here with additions and multiplications only.
 */
class Random {
public:
  explicit Random(std::uint64_t seed)
  : engine_(seed)
  {}

  /** \brief Uniform in [0, 1). */
  double uniform();

  /** \brief Uniform in [low, high). */
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

  /** \brief Uniform integer from low to high, both included; low <= high. */
  int integer(int low, int high);

  /** \brief True with the given probability, 0 to 1. */
  bool chance(double probability) { return uniform() < probability; }

  /** \brief Nearly normal with mean 0 and standard deviation 1: the sum of twelve
   * uniforms, never beyond 6. */
  double normal();

private:
  std::mt19937_64 engine_;
};

} // namespace pcl_mrf_planes::scenes
