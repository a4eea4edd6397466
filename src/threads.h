// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"
#include "thread_team.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {

/// Calls work(part) for every part below \a parts. Parts must not depend on each other, so
/// that the result is the same at any thread count. They are handed out to the calling
/// thread, from the first, and to those of its team that are there, from the last, or to all
/// in their order: it never waits for one that has not begun, as where other programs have
/// the cores. Of what work throws one is thrown again here, after all parts.
template <typename Work>
void parallelParts(int parts, unsigned int threads, const Work& work,
                   ThreadTeam::Order order = ThreadTeam::Order::ANY)
{
  if (parts > 1 && threadCount(threads) > 1)
    if (ThreadTeam* team = ThreadTeam::ofThisThread()) {
      const struct Task {
        const Work& work;
        FrameMemory* memory; ///< of the caller, for those of its team as well
      } task = {work, FrameMemory::ofThisThread()};
      team->run(
          parts, &task,
          [](const void* what, int part) {
            const Task& all = *static_cast<const Task*>(what);
            const FrameMemoryScope scope(all.memory);
            all.work(part);
          },
          order);
      return;
    }
  for (int part = 0; part < parts; ++part)
    work(part);
}

/// Rows of an image in bands. By themselves they are as many as the rows allow, whatever the
/// number of threads; who asks for a number of threads must not let it change the result.
struct Bands {
  int rows;
  int count;

  /// \param[in] most bands, at least 1
  explicit Bands(int of_rows, int most = 16)
  : rows(of_rows)
  , count(std::clamp(of_rows, 1, most))
  {}

  /// The first row of a band; rows at \a count.
  int begin(int band) const
  {
    return static_cast<int>(static_cast<long long>(rows) * band / count);
  }
};

/// Calls work(row) for every row below \a rows, as parallelParts() does for parts.
template <typename Work>
void parallelRows(int rows, unsigned int threads, const Work& work)
{
  const Bands bands(rows);
  parallelParts(bands.count, threads, [&](int band) {
    const int end =
        bands.begin(band + 1); // a division, which rows may be too short for
    for (int row = bands.begin(band); row < end; ++row)
      work(row);
  });
}

/// Adds to a sum what parts of it hold; to a row of sums, one by one.
template <typename Sum>
void addTo(Sum& sum, const Sum& part)
{
  sum += part;
}
template <typename Sum>
void addTo(FrameVector<Sum>& sums, const FrameVector<Sum>& parts)
{
  for (std::size_t k = 0; k < sums.size(); ++k)
    addTo(sums[k], parts[k]);
}

/// Sum of what add(first, last, sum) adds to \a none for rows of an image, half open. The
/// bands do not depend on the number of threads: numbers are added in the same order always.
template <typename Sum, typename Add>
Sum sumOfBands(int rows, unsigned int threads, const Sum& none, const Add& add)
{
  constexpr int FEW =
      8; // each has a sum of its own, of as many numbers as there are labels
  const Bands bands(rows, FEW);
  FrameVector<Sum> sums(static_cast<std::size_t>(bands.count), none);
  parallelParts(bands.count, threads, [&](int band) {
    add(bands.begin(band), bands.begin(band + 1), sums[static_cast<std::size_t>(band)]);
  });
  for (std::size_t band = 1; band < sums.size(); ++band)
    addTo(sums[0], sums[band]);
  return std::move(sums[0]);
}

/// How far each strip of an image has come.
class StripProgress {
public:
  explicit StripProgress(int strips)
  : done_(static_cast<std::size_t>(strips))
  {}

  /// Waits until a strip has done more than so many steps.
  void await(int strip, int steps) const
  {
    for (Patience patience; done(strip).load(std::memory_order_acquire) <= steps;)
      patience.wait();
  }
  void reach(int strip, int steps)
  {
    done_[static_cast<std::size_t>(strip)].steps.store(steps,
                                                       std::memory_order_release);
  }

private:
  /// On a cache line of its own.
  struct alignas(64) Counter {
    std::atomic<int> steps{0};
  };

  const std::atomic<int>& done(int strip) const
  {
    return done_[static_cast<std::size_t>(strip)].steps;
  }

  FrameVector<Counter> done_;
};

/// Calls work(strip, step) for every step of every strip, as if step by step and in each of
/// them strip by strip: a strip takes a step when the one before it has taken it. What a
/// strip reads of the others must stay as it is after their steps up to that.
template <typename Work>
void staggeredSteps(int strips, int steps, unsigned int threads, const Work& work)
{
  StripProgress progress(strips);
  const auto takeSteps = [&](int strip) {
    try {
      for (int step = 0; step < steps; ++step) {
        if (strip > 0)
          progress.await(strip - 1, step);
        work(strip, step);
        progress.reach(strip, step + 1);
      }
    }
    catch (...) { // nobody waits for what will not come
      progress.reach(strip, steps);
      throw;
    }
  };
  parallelParts(strips, threads, takeSteps, ThreadTeam::Order::FORWARD);
}

} // namespace pcl_mrf_planes
