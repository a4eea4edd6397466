// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef _OPENMP
#include <omp.h>
#endif

namespace pcl_mrf_planes {

/// The number of threads that a setting asks for; 0 means as many as there are cores.
inline int threadCount(unsigned int setting)
{
#ifdef _OPENMP
  return setting == 0 ? omp_get_num_procs() : static_cast<int>(setting);
#else
  static_cast<void>(setting);
  return 1;
#endif
}

/// Calls work(row) for every row below \a rows. Rows must not depend on each other, so
/// that the result is the same at any thread count.
template <typename Work>
void parallelRows(int rows, unsigned int threads, Work&& work)
{
#ifdef _OPENMP
  const int count = threadCount(threads);
  if (count > 1) {
#pragma omp parallel for schedule(static) num_threads(count)
    for (int row = 0; row < rows; ++row)
      work(row);
    return;
  }
#endif
  static_cast<void>(threads);
  for (int row = 0; row < rows; ++row)
    work(row);
}

} // namespace pcl_mrf_planes
