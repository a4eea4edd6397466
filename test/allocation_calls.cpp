// SPDX-License-Identifier: BSD-3-Clause
//
// The functions of the C library for the whole program, replaced by some that count and call
// them.
#include "allocation_calls.h"

#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define PCL_MRF_PLANES_OTHER_ALLOCATOR
#endif
#elif defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define PCL_MRF_PLANES_OTHER_ALLOCATOR
#endif

#ifdef PCL_MRF_PLANES_OTHER_ALLOCATOR

namespace pcl_mrf_planes::test {

bool countsAllocations()
{
  return false;
}

std::size_t allocationCalls()
{
  return 0;
}

} // namespace pcl_mrf_planes::test

#else

namespace {

std::atomic<std::size_t> calls{0};

/// The function of that name which this program would have had.
template <typename Function>
Function* original(const char* name)
{
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

void* malloc(std::size_t size)
{
  static auto* const call = original<void*(std::size_t)>("malloc");
  calls.fetch_add(1, std::memory_order_relaxed);
  return call(size);
}

void* realloc(void* memory, std::size_t size)
{
  static auto* const call = original<void*(void*, std::size_t)>("realloc");
  calls.fetch_add(1, std::memory_order_relaxed);
  return call(memory, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size)
{
  static auto* const call =
      original<void*(std::size_t, std::size_t)>("aligned_alloc");
  calls.fetch_add(1, std::memory_order_relaxed);
  return call(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
{
  static auto* const call =
      original<int(void**, std::size_t, std::size_t)>("posix_memalign");
  calls.fetch_add(1, std::memory_order_relaxed);
  return call(memory, alignment, size);
}
}

namespace pcl_mrf_planes::test {

bool countsAllocations()
{
  return true;
}

std::size_t allocationCalls()
{
  return calls.load(std::memory_order_relaxed);
}

} // namespace pcl_mrf_planes::test

#endif
