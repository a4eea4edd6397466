// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_mrf_planes::test {

/// Whether calls are counted at all: not where a sanitizer has an allocator of its own.
bool countsAllocations();

/// How often the program has asked for memory up to now, on any thread: malloc, realloc and
/// the aligned ones, and so operator new and what libraries do as well.
std::size_t allocationCalls();

} // namespace pcl_mrf_planes::test
