// SPDX-License-Identifier: BSD-3-Clause
//
// operator new and delete of the whole program, replaced by some that count.
#include "allocation_calls.h"

#include "sanitizers.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

#if PCL_MRF_PLANES_SANITIZED // which has operators of its own

std::size_t pcl_mrf_planes::test::allocationCalls()
{
  return 0;
}

#else

namespace {

std::atomic<std::size_t> calls{0};

void* newMemory(std::size_t size, std::size_t alignment)
{
  calls.fetch_add(1, std::memory_order_relaxed);
  const std::size_t rounded =
      (std::max<std::size_t>(size, 1) + alignment - 1) / alignment * alignment;
  void* const memory = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                           ? std::malloc(rounded)
                           : std::aligned_alloc(alignment, rounded);
  if (memory == nullptr)
    throw std::bad_alloc();
  return memory;
}

} // namespace

// The forms that are not here call one of these.
void* operator new(std::size_t size)
{
  return newMemory(size, 1);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return newMemory(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  std::free(memory);
}

namespace pcl_mrf_planes::test {

std::size_t allocationCalls()
{
  return calls.load(std::memory_order_relaxed);
}

} // namespace pcl_mrf_planes::test

#endif
