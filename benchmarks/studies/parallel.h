// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace pcl_mrf_planes::benchmarks {

/** \brief Do jobs 0 to count - 1, several at a time, in any order.
 * \throws what the first job to fail throws, once the others have ended */
void doAll(std::size_t count, unsigned int threads,
           const std::function<void(std::size_t)>& job);

} // namespace pcl_mrf_planes::benchmarks
