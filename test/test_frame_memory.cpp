// SPDX-License-Identifier: BSD-3-Clause
//
// Memory that is kept from frame to frame, and the vectors that take theirs from it.
#include "frame_memory.h"
#include "threads.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <thread>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {
namespace {

bool onCacheLine(const void* block)
{
  return reinterpret_cast<std::uintptr_t>(block) % 64 == 0;
}

TEST(FrameMemoryTest, BlocksOfAllSizesHoldWhatTheyWereTakenFor)
{
  FrameMemory memory;
  std::vector<std::pair<void*, std::size_t>> blocks;
  for (std::size_t bytes = 1; bytes < 5000; bytes += bytes < 300 ? 1 : 61)
    blocks.emplace_back(memory.take(bytes), bytes);
  for (const auto& [block, bytes] : blocks) {
    EXPECT_TRUE(onCacheLine(block));
    std::memset(block, static_cast<int>(bytes % 251), bytes);
  }
  for (const auto& [block, bytes] : blocks) { // none overlaps another
    const auto* written = static_cast<const std::uint8_t*>(block);
    EXPECT_EQ(written[0], bytes % 251);
    EXPECT_EQ(written[bytes - 1], bytes % 251);
    memory.give(block, bytes);
  }
}

TEST(FrameMemoryTest, WhatIsGivenBackIsTakenAgain)
{
  if (!FrameMemory::keeps())
    GTEST_SKIP() << "a sanitizer is to see every vector";
  FrameMemory memory;
  for (const std::size_t bytes : {1U, 64U, 65U, 1000U, 123457U}) {
    void* first = memory.take(bytes);
    void* second = memory.take(bytes);
    EXPECT_NE(first, second);
    memory.give(first, bytes);
    EXPECT_EQ(memory.take(bytes), first);
    memory.give(first, bytes);
    memory.give(second, bytes);
  }
}

TEST(FrameMemoryTest, VectorsTakeWhatIsPutUp)
{
  FrameMemory memory;
  const FrameVector<int> outside(3, 1);
  EXPECT_EQ(outside.get_allocator().memory(), nullptr);
  const FrameMemoryScope scope(&memory);
  FrameVector<int> inside(outside);
  EXPECT_EQ(inside.get_allocator().memory(), &memory) << "a copy is made here";
  {
    const FrameMemoryScope none(nullptr);
    const FrameVector<int> copy(inside);
    EXPECT_EQ(copy.get_allocator().memory(), nullptr);
    const int* numbers = inside.data();
    FrameVector<int> moved;
    moved = std::move(inside);
    EXPECT_EQ(moved.data(), numbers);
    EXPECT_EQ(moved.get_allocator().memory(), &memory) << "it keeps its memory";
  }
  EXPECT_EQ(FrameMemory::ofThisThread(), &memory) << "as before the inner scope";
}

TEST(FrameMemoryTest, AThreadHasItsOwn)
{
  FrameMemory memory;
  const FrameMemoryScope scope(&memory);
  std::thread([] { EXPECT_EQ(FrameMemory::ofThisThread(), nullptr); }).join();
}

TEST(FrameMemoryTest, ATeamSharesThatOfItsMaker)
{
  FrameMemory memory;
  const FrameMemoryScope scope(&memory);
  const ThreadTeam team(3);
  for (int round = 0; round < 50; ++round) {
    FrameVector<FrameVector<int>> parts(32);
    parallelParts(32, 3, [&](int part) {
      EXPECT_EQ(FrameMemory::ofThisThread(), &memory);
      FrameVector<int>& own = parts[static_cast<std::size_t>(part)];
      for (int k = 0; k < 40 * part; ++k)
        own.push_back(part);
    });
    for (int part = 0; part < 32; ++part) {
      const FrameVector<int>& own = parts[static_cast<std::size_t>(part)];
      EXPECT_EQ(own, FrameVector<int>(static_cast<std::size_t>(40 * part), part));
    }
  }
}

} // namespace
} // namespace pcl_mrf_planes
