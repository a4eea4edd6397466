// SPDX-License-Identifier: BSD-3-Clause
#include "threads.h"

#include <pcl_mrf_planes/thread_scope.h>

#include <gtest/gtest.h>

#include <malloc.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace pcl_mrf_planes {
namespace {

constexpr unsigned int THREADS = 4;

/// How often each part is done.
std::vector<int> timesDone(int parts)
{
  std::vector<std::atomic<int>> times(static_cast<std::size_t>(parts));
  parallelParts(parts, THREADS,
                [&](int part) { ++times[static_cast<std::size_t>(part)]; });
  return {times.begin(), times.end()};
}

void expectEachOnce(int parts)
{
  const std::vector<int> times = timesDone(parts);
  EXPECT_EQ(std::vector<int>(times.size(), 1), times) << parts << " parts";
}

TEST(ThreadTeam, DoesEveryPartOnce)
{
  const ThreadTeam team(THREADS);
  for (int parts = 0; parts < 200; ++parts)
    expectEachOnce(parts);
}

TEST(ThreadTeam, DoesMorePartsThanAreHandedOut)
{
  const ThreadTeam team(THREADS);
  expectEachOnce(1 << 20);
}

TEST(ThreadTeam, BeginsPartsInOrderIfTheyMind)
{
  constexpr int PARTS = 40;
  const ThreadTeam team(THREADS);
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> begun{0};
    std::vector<int> before(PARTS); // so many had begun, for each part
    parallelParts(
        PARTS, THREADS,
        [&](int part) { before[static_cast<std::size_t>(part)] = begun++; },
        ThreadTeam::Order::FORWARD);
    // Of those handed out before, each other thread may have one that it has yet to begin.
    for (int part = 0; part < PARTS; ++part)
      EXPECT_GE(before[static_cast<std::size_t>(part)] + static_cast<int>(THREADS) - 1,
                part);
  }
}

TEST(ThreadTeam, WhatAPartThrowsArrivesAfterAllParts)
{
  const ThreadTeam team(THREADS);
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> done{0};
    try {
      parallelParts(16, THREADS, [&](int part) {
        ++done;
        if (part == 5)
          throw std::runtime_error("part five");
      });
      FAIL() << "nothing was thrown";
    }
    catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "part five");
    }
    // Where there is one core, they are done one by one up to the one that throws.
    EXPECT_EQ(done, ThreadTeam::ofThisThread() != nullptr ? 16 : 6);
    expectEachOnce(7); // the team goes on
  }
}

TEST(ThreadTeam, WorkWithinWorkRunsOneByOne)
{
  const ThreadTeam team(THREADS);
  std::vector<std::vector<int>> orders(8);
  parallelParts(8, THREADS, [&](int part) {
    EXPECT_EQ(ThreadTeam::ofThisThread(), nullptr);
    parallelParts(5, THREADS, [&](int inner) {
      orders[static_cast<std::size_t>(part)].push_back(inner);
    });
  });
  for (const std::vector<int>& order : orders)
    EXPECT_EQ(order, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(ThreadTeam, TheOuterOneStays)
{
  const ThreadTeam outer(THREADS);
  ThreadTeam* const mine = ThreadTeam::ofThisThread();
  {
    const ThreadTeam inner(THREADS);
    EXPECT_EQ(ThreadTeam::ofThisThread(), mine);
  }
  EXPECT_EQ(ThreadTeam::ofThisThread(), mine);
  expectEachOnce(20);
}

TEST(ThreadTeam, OneThreadIsNoTeam)
{
  const ThreadTeam team(1);
  EXPECT_EQ(ThreadTeam::ofThisThread(), nullptr);
  expectEachOnce(20);
}

TEST(ThreadTeam, TeamsOfSeveralThreadsDoNotMeet)
{
  std::vector<std::thread> makers;
  makers.reserve(4);
  for (int maker = 0; maker < 4; ++maker)
    makers.emplace_back([] {
      for (int round = 0; round < 20; ++round) {
        const ThreadTeam team(2 + static_cast<unsigned int>(round % 3));
        expectEachOnce(30);
      }
    });
  for (std::thread& maker : makers)
    maker.join();
}

TEST(ThreadScope, SharesEveryPartOnceAtAnyNumberOfThreads)
{
  for (const unsigned int threads : {0U, 1U, 2U, THREADS}) {
    const ThreadScope scope(threads);
    std::vector<std::atomic<int>> times(50);
    scope.share(50, [&](int part) { ++times[static_cast<std::size_t>(part)]; });
    for (const std::atomic<int>& of_part : times)
      EXPECT_EQ(of_part, 1) << threads << " threads";
    scope.share(0, [](int part) { ADD_FAILURE() << part << " of none"; });
  }
}

TEST(ThreadScope, WhatAPartThrowsArrives)
{
  const ThreadScope scope(THREADS);
  EXPECT_THROW(scope.share(8,
                           [](int part) {
                             if (part == 5)
                               throw std::runtime_error("five");
                           }),
               std::runtime_error);
}

/// Bytes that are allocated now; 0 where another allocator is in place (sanitizers).
std::size_t allocated()
{
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

TEST(ThreadTeam, ThreadsThatEndLeaveNothingBehind)
{
  const auto runInThreads = [](int threads) {
    for (int k = 0; k < threads; ++k)
      std::thread([] {
        const ThreadTeam team(2);
        expectEachOnce(30);
      }).join();
  };
  runInThreads(500);
  const std::size_t before = allocated();
  runInThreads(3000);
  // Helpers that come late hold what they are about to look at.
  for (int k = 0; k < 100 && allocated() > before + 20000; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_LE(allocated(), before + 20000);
}

TEST(Bands, CoverEveryRowOnceInOrder)
{
  for (const int rows : {0, 1, 2, 15, 16, 17, 1000}) {
    const Bands bands(rows);
    EXPECT_EQ(bands.begin(0), 0);
    EXPECT_EQ(bands.begin(bands.count), rows);
    for (int band = 0; band < bands.count; ++band)
      EXPECT_LE(bands.begin(band), bands.begin(band + 1));
  }
}

TEST(SumOfBands, DoesNotDependOnTheTeam)
{
  // Numbers whose sum depends on the order of adding.
  std::vector<double> numbers(1000);
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = 1.0 / static_cast<double>(3 * k + 1);
  const auto sum = [&](unsigned int threads) {
    return sumOfBands(static_cast<int>(numbers.size()), threads, 0.0,
                      [&](int first, int last, double& part) {
                        part = std::accumulate(numbers.begin() + first,
                                               numbers.begin() + last, part);
                      });
  };
  const double alone = sum(1);
  EXPECT_NEAR(alone, std::accumulate(numbers.begin(), numbers.end(), 0.0), 1e-12);
  const ThreadTeam team(THREADS);
  EXPECT_EQ(sum(THREADS), alone);
}

} // namespace
} // namespace pcl_mrf_planes
