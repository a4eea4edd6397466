// SPDX-License-Identifier: BSD-3-Clause
//
// operator new and delete of the whole program, replaced by malloc and free that count.
// Counting is off but while an AllocationCount lives, so that times are not disturbed.
#include "allocation_count.h"

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<bool> counting{false};
std::atomic<std::int64_t> allocation_calls{0};
std::atomic<std::int64_t> allocated_bytes{0};
std::atomic<std::int64_t> held_bytes{0};
std::atomic<std::int64_t> most_held_bytes{0};

void countNew(void* memory, std::size_t size)
{
  if (!counting.load(std::memory_order_relaxed))
    return;
  ++allocation_calls;
  allocated_bytes += static_cast<std::int64_t>(size);
  const auto usable = static_cast<std::int64_t>(malloc_usable_size(memory));
  const std::int64_t held = held_bytes += usable;
  std::int64_t most = most_held_bytes.load();
  while (held > most && !most_held_bytes.compare_exchange_weak(most, held)) {
  }
}

void* newMemory(std::size_t size, std::size_t alignment)
{
  const std::size_t rounded = std::max<std::size_t>(1, size);
  void* const memory = alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                           ? std::malloc(rounded)
                           : std::aligned_alloc(alignment, (rounded + alignment - 1) /
                                                               alignment * alignment);
  if (memory != nullptr)
    countNew(memory, size);
  return memory;
}

void* newOrThrow(std::size_t size, std::size_t alignment)
{
  void* const memory = newMemory(size, alignment);
  if (memory == nullptr)
    throw std::bad_alloc();
  return memory;
}

void deleteMemory(void* memory) noexcept
{
  if (memory != nullptr && counting.load(std::memory_order_relaxed))
    held_bytes -= static_cast<std::int64_t>(malloc_usable_size(memory));
  std::free(memory);
}

constexpr std::size_t PLAIN = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

std::size_t numberOf(std::align_val_t alignment)
{
  return static_cast<std::size_t>(alignment);
}

} // namespace

// The forms that are not here call one of these.
void* operator new(std::size_t size)
{
  return newOrThrow(size, PLAIN);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
  return newMemory(size, PLAIN);
}
void* operator new(std::size_t size, std::align_val_t alignment)
{
  return newOrThrow(size, numberOf(alignment));
}
void* operator new(std::size_t size, std::align_val_t alignment,
                   const std::nothrow_t&) noexcept
{
  return newMemory(size, numberOf(alignment));
}
void operator delete(void* memory) noexcept
{
  deleteMemory(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  deleteMemory(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept
{
  deleteMemory(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept
{
  deleteMemory(memory);
}

namespace pcl_mrf_planes::benchmarks {

AllocationCount::AllocationCount()
{
  allocation_calls = allocated_bytes = held_bytes = most_held_bytes = 0;
  counting = true;
}

AllocationCount::~AllocationCount()
{
  counting = false;
}

std::int64_t AllocationCount::allocations() const
{
  return allocation_calls;
}
std::int64_t AllocationCount::bytes() const
{
  return allocated_bytes;
}
std::int64_t AllocationCount::held() const
{
  return held_bytes;
}
std::int64_t AllocationCount::mostHeld() const
{
  return most_held_bytes;
}

} // namespace pcl_mrf_planes::benchmarks
