// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <oneapi/tbb/spin_mutex.h>

#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Memory of what lives no longer than a frame: blocks that are given back are kept for
 * the next one, so that a frame like one before it asks the system for nothing.
 *
 * The stages need some hundred vectors a frame, of sizes that depend on the cloud. A
 * PlaneSegmenter owns one of these and puts it up (FrameMemoryScope) while it works; vectors
 * that are made meanwhile (FrameVector) take their memory from it. Blocks come in four sizes
 * to each doubling, so that a fifth of one is unused at most, and there are of each size as
 * many as were in use at once.
 *
 * Several threads may use one at the same time. Where a sanitizer watches, nothing is kept:
 * it would not see what is wrong otherwise. */
class FrameMemory {
public:
  FrameMemory() = default;
  FrameMemory(const FrameMemory&) = delete;
  FrameMemory& operator=(const FrameMemory&) = delete;
  /// All that was taken must be given back before.
  ~FrameMemory();

  /// A block of at least so many bytes, on a cache line. Throws std::bad_alloc
  void* take(std::size_t bytes);

  /// \param[in] bytes as many as the block was taken for
  void give(void* block, std::size_t bytes) noexcept;

  /// Whether what is given back is kept at all.
  static bool keeps() noexcept;

  /// What is put up for the calling thread; null: nothing.
  static FrameMemory* ofThisThread() noexcept;

private:
  friend class FrameMemoryScope;

  static constexpr std::size_t SIZES = 236; ///< from 64 bytes to all that there are

  oneapi::tbb::spin_mutex
      mutex_; ///< held for a few instructions: to sleep takes longer
  /// Blocks that nobody uses, the last one given back at the end. What they hold is not looked
  /// at: it may be far from the caches by now.
  std::array<std::vector<void*>, SIZES> spare_;
};

/// Puts up a memory, or none, for the thread that makes the scope and as long as it lasts.
class FrameMemoryScope {
public:
  explicit FrameMemoryScope(FrameMemory* memory) noexcept;
  FrameMemoryScope(const FrameMemoryScope&) = delete;
  FrameMemoryScope& operator=(const FrameMemoryScope&) = delete;
  ~FrameMemoryScope();

private:
  FrameMemory* before_;
};

/** \brief Takes memory from what was put up where the container was made; from operator new
 * where nothing was. Copies go by where they are made, what is moved keeps its memory. */
template <typename T>
class FrameAllocator {
public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;
  using is_always_equal = std::false_type;

  FrameAllocator() noexcept
  : memory_(FrameMemory::ofThisThread())
  {}
  template <typename U>
  FrameAllocator(
      const FrameAllocator<U>& other) noexcept // NOLINT: as allocators convert
  : memory_(other.memory())
  {}

  T* allocate(std::size_t count)
  {
    return memory_ != nullptr ? static_cast<T*>(memory_->take(count * SIZE))
                              : std::allocator<T>().allocate(count);
  }

  void deallocate(T* block, std::size_t count) noexcept
  {
    if (memory_ != nullptr)
      memory_->give(block, count * SIZE);
    else
      std::allocator<T>().deallocate(block, count);
  }

  FrameAllocator select_on_container_copy_construction() const { return {}; }
  FrameMemory* memory() const { return memory_; }

private:
  static constexpr std::size_t SIZE =
      sizeof(T); // NOLINT(bugprone-sizeof-expression): T may be a pointer

  FrameMemory* memory_;
};

template <typename T, typename U>
bool operator==(const FrameAllocator<T>& a, const FrameAllocator<U>& b)
{
  return a.memory() == b.memory();
}
template <typename T, typename U>
bool operator!=(const FrameAllocator<T>& a, const FrameAllocator<U>& b)
{
  return !(a == b);
}

/// A vector that must not outlive the frame.
template <typename T>
using FrameVector = std::vector<T, FrameAllocator<T>>;

} // namespace pcl_mrf_planes
