// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pcl_mrf_planes::benchmarks {

/** \brief The most memory of this process that was resident above what is resident now
 * when the object is made. Linux only; elsewhere 0. */
class ResidentPeak {
public:
  ResidentPeak();
  std::int64_t bytes() const;

private:
  std::int64_t start_;
};

} // namespace pcl_mrf_planes::benchmarks
