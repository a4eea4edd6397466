// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_mrf_planes::test {

/// Calls of operator new by the program up to now, on any thread and in any library; 0 where a
/// sanitizer has operators of its own.
std::size_t allocationCalls();

} // namespace pcl_mrf_planes::test
