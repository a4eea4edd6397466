// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pcl_mrf_planes::benchmarks {

/** \brief What operator new was asked for since the object was made; one object at a
 * time. Memory that is taken without operator new (malloc, Eigen's own) does not count.
 */
class AllocationCount {
public:
  AllocationCount();
  ~AllocationCount();
  AllocationCount(const AllocationCount&) = delete;
  AllocationCount& operator=(const AllocationCount&) = delete;

  std::int64_t allocations() const; ///< calls of operator new
  std::int64_t bytes() const;       ///< that these calls were asked for
  std::int64_t held() const;        ///< bytes taken and not given back
  std::int64_t mostHeld() const;    ///< the most that held() ever was
};

} // namespace pcl_mrf_planes::benchmarks
