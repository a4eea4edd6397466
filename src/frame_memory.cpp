// SPDX-License-Identifier: BSD-3-Clause
#include "frame_memory.h"

#include "sanitizers.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>

namespace pcl_mrf_planes {

namespace {

constexpr bool WATCHED = PCL_MRF_PLANES_SANITIZED != 0; // by a sanitizer
constexpr std::align_val_t CACHE_LINE{64};

thread_local FrameMemory* memory_of_this_thread = nullptr;

/// One of the sizes of blocks: five to eight quarters of a power of two.
struct BlockSize {
  std::size_t number; ///< among all sizes, ascending
  std::size_t bytes;

  /// The least one that holds so many bytes.
  explicit BlockSize(std::size_t wanted)
  {
    constexpr std::size_t LEAST = 64;
    constexpr std::size_t LEAST_EXPONENT = 5; // of LEAST - 1
    const std::uint64_t last = std::max(wanted, LEAST) - 1;
    const auto exponent = static_cast<std::size_t>(63 - __builtin_clzll(last));
    const std::size_t quarter = (last >> (exponent - 2)) & 3U;
    number = 4 * (exponent - LEAST_EXPONENT) + quarter;
    bytes = (quarter + 5) << (exponent - 2);
  }
};

} // namespace

FrameMemory::~FrameMemory()
{
  for (const std::vector<void*>& blocks : spare_)
    for (void* block : blocks)
      ::operator delete(block, CACHE_LINE);
}

void* FrameMemory::take(std::size_t bytes)
{
  const BlockSize size(bytes);
  if (!WATCHED) {
    const std::lock_guard<oneapi::tbb::spin_mutex> lock(mutex_);
    if (std::vector<void*>& spare = spare_[size.number]; !spare.empty()) {
      void* block = spare.back();
      spare.pop_back();
      return block;
    }
  }
  return ::operator new(WATCHED ? bytes : size.bytes, CACHE_LINE);
}

void FrameMemory::give(void* block, std::size_t bytes) noexcept
{
  if (!WATCHED) {
    const BlockSize size(bytes);
    const std::lock_guard<oneapi::tbb::spin_mutex> lock(mutex_);
    try {
      spare_[size.number].push_back(block);
      return;
    }
    catch (const std::bad_alloc&) { // no memory to remember it by
    }
  }
  ::operator delete(block, CACHE_LINE);
}

bool FrameMemory::keeps() noexcept
{
  return !WATCHED;
}

FrameMemory* FrameMemory::ofThisThread() noexcept
{
  return memory_of_this_thread;
}

FrameMemoryScope::FrameMemoryScope(FrameMemory* memory) noexcept
: before_(memory_of_this_thread)
{
  memory_of_this_thread = memory;
}

FrameMemoryScope::~FrameMemoryScope()
{
  memory_of_this_thread = before_;
}

} // namespace pcl_mrf_planes
