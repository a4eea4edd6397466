// SPDX-License-Identifier: BSD-3-Clause
#include "thread_team.h"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <utility>

namespace pcl_mrf_planes {

int threadCount(unsigned int setting)
{
  return setting == 0 ? oneapi::tbb::info::default_concurrency()
                      : static_cast<int>(setting);
}

/// Where the maker of a team puts up its work and helpers take parts of it.
///
/// A job's number, its parts and the next of them are one word. Who takes a part reads the
/// job first and then moves the word on: if that succeeds, the word has not changed meanwhile,
/// and the job neither, as another one is put up only when all parts of the last are done.
class ThreadTeam::Board {
public:
  static constexpr std::uint64_t MOST_PARTS = (1U << 20U) - 1;

  void run(int parts, const void* work, Call call)
  {
    work_.store(work, std::memory_order_relaxed);
    call_.store(call, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t job = (word_.load(std::memory_order_relaxed) >> 2 * BITS) + 1;
    word_.store((job << 2 * BITS) | (static_cast<std::uint64_t>(parts) << BITS),
                std::memory_order_release);
    while (doPart())
      ;
    for (Patience patience; done_.load(std::memory_order_acquire) < parts;)
      patience.wait();
    if (failure_)
      std::rethrow_exception(std::exchange(failure_, nullptr));
  }

  /// Takes parts until the team ends.
  void help()
  {
    for (Patience patience; !ended_.load(std::memory_order_acquire);)
      if (doPart())
        patience = {};
      else
        patience.wait();
  }

  void end() { ended_.store(true, std::memory_order_release); }

private:
  static constexpr unsigned BITS =
      20; // of the parts, and of the next one; the job's are 24

  /// \return whether there was a part to do
  bool doPart()
  {
    std::uint64_t word = word_.load(std::memory_order_acquire);
    const void* work = work_.load(std::memory_order_relaxed);
    const Call call = call_.load(std::memory_order_relaxed);
    const std::uint64_t parts = (word >> BITS) & MOST_PARTS;
    const std::uint64_t part = word & MOST_PARTS;
    if (part >= parts)
      return false;
    if (!word_.compare_exchange_strong(word, word + 1, std::memory_order_acq_rel))
      return true; // somebody else took it
    try {
      call(work, static_cast<int>(part));
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock(failing_);
      failure_ = std::current_exception();
    }
    done_.fetch_add(1, std::memory_order_acq_rel);
    return true;
  }

  std::atomic<std::uint64_t> word_{0};
  std::atomic<const void*> work_{nullptr};
  std::atomic<Call> call_{nullptr};
  std::atomic<int> done_{0};
  std::atomic<bool> ended_{false};
  std::mutex failing_;
  std::exception_ptr failure_;
};

namespace {

thread_local ThreadTeam* team_of_this_thread = nullptr;

/// Where helpers come from, kept for the next team.
oneapi::tbb::task_arena& helpersOfThisThread(int count)
{
  thread_local std::unique_ptr<oneapi::tbb::task_arena> arena;
  if (!arena || arena->max_concurrency() != count)
    arena = std::make_unique<oneapi::tbb::task_arena>(count, 0U);
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDelete): it takes arena for a local variable
  return *arena;
}

} // namespace

ThreadTeam::ThreadTeam(unsigned int threads)
{
  // More of them than cores would take turns.
  const int count =
      std::min(threadCount(threads), oneapi::tbb::info::default_concurrency());
  if (count < 2 || team_of_this_thread != nullptr)
    return;
  board_ = std::make_shared<Board>();
  try {
    for (int helper = 1; helper < count; ++helper)
      helpersOfThisThread(count - 1).enqueue([board = board_] { board->help(); });
  }
  catch (...) { // those that are there already must not look out for ever
    board_->end();
    throw;
  }
  team_of_this_thread = this;
}

ThreadTeam::~ThreadTeam()
{
  if (!board_)
    return;
  board_->end(); // helpers that have not begun find out then
  team_of_this_thread = nullptr;
}

void ThreadTeam::run(int parts, const void* work, Call call)
{
  team_of_this_thread = nullptr; // what work asks for runs one by one
  struct Return {
    ThreadTeam* team;
    ~Return() { team_of_this_thread = team; }
  } back{this};
  if (static_cast<std::uint64_t>(parts) <= Board::MOST_PARTS)
    board_->run(parts, work, call);
  else // of a size that no image has
    for (int part = 0; part < parts; ++part)
      call(work, part);
}

ThreadTeam* ThreadTeam::ofThisThread()
{
  return team_of_this_thread;
}

} // namespace pcl_mrf_planes
