// SPDX-License-Identifier: BSD-3-Clause
#include "thread_team.h"

#include "threads.h"

#include <pcl_mrf_planes/thread_scope.h>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {

int threadCount(unsigned int setting)
{
  return setting == 0 ? oneapi::tbb::info::default_concurrency()
                      : static_cast<int>(setting);
}

/// Where the maker of a team puts up its work and helpers take parts of it: the maker the
/// first that is left and they the last, so that each works on the same end of the image from
/// one job to the next and finds it in the cache of its core. Jobs in order: all the first.
///
/// A job's number, its parts and how many of them have been taken from either end are one
/// word. Who takes a part reads the job first and then moves the word on: if that succeeds,
/// the word has not changed meanwhile, and the job neither, as another one is put up only when
/// all parts of the last are done.
class ThreadTeam::Board {
public:
  static constexpr std::uint64_t MOST_PARTS = (1U << 14U) - 1;

  void run(int parts, const void* work, Call call, Order order)
  {
    work_.store(work, std::memory_order_relaxed);
    call_.store(call, std::memory_order_relaxed);
    order_.store(order, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t job = (word_.load(std::memory_order_relaxed) >> 3 * BITS) + 1;
    word_.store((job << 3 * BITS) | (static_cast<std::uint64_t>(parts) << 2 * BITS),
                std::memory_order_release);
    while (doPart(Order::FORWARD))
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
      if (doPart(Order::ANY))
        patience = {};
      else
        patience.wait();
  }

  void end() { ended_.store(true, std::memory_order_release); }

private:
  static constexpr unsigned BITS =
      14; // of the parts, and of those taken from an end; the job's are 22

  /// \param[in] order which part, if the job does not mind: the first or the last
  /// \return whether there was a part to do
  bool doPart(Order order)
  {
    std::uint64_t word = word_.load(std::memory_order_acquire);
    const void* work = work_.load(std::memory_order_relaxed);
    const Call call = call_.load(std::memory_order_relaxed);
    if (order_.load(std::memory_order_relaxed) == Order::FORWARD)
      order = Order::FORWARD;
    const auto field = [word](unsigned place) {
      return static_cast<int>((word >> place * BITS) & MOST_PARTS);
    };
    const int first = field(0);
    const int last = field(1);
    const int parts = field(2);
    if (first + last >= parts)
      return false;
    const bool forward = order == Order::FORWARD;
    const std::uint64_t taken = std::uint64_t{1} << (forward ? 0U : BITS);
    if (!word_.compare_exchange_strong(word, word + taken, std::memory_order_acq_rel))
      return true; // somebody else took one
    try {
      call(work, forward ? first : parts - 1 - last);
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
  std::atomic<Order> order_{Order::ANY};
  std::atomic<int> done_{0};
  std::atomic<bool> ended_{false};
  std::mutex failing_;
  std::exception_ptr failure_;
};

namespace {

thread_local ThreadTeam* team_of_this_thread = nullptr;

using Arena = oneapi::tbb::task_arena;

/// Where helpers come from, of threads that have ended, for those that follow: an arena that
/// is destroyed loses the tasks that no helper has taken yet, and the memory of them.
class SpareArenas {
public:
  std::unique_ptr<Arena> take(int count)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto spare =
        std::find_if(arenas_.begin(), arenas_.end(), [count](const auto& arena) {
          return arena->max_concurrency() == count;
        });
    if (spare == arenas_.end())
      return std::make_unique<Arena>(count, 0U);
    std::unique_ptr<Arena> arena = std::move(*spare);
    arenas_.erase(spare);
    return arena;
  }

  void keep(std::unique_ptr<Arena> arena)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    arenas_.push_back(std::move(arena));
  }

private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Arena>> arenas_;
};

/// Never destroyed: threads may end after everything else.
SpareArenas& spareArenas()
{
  static SpareArenas& spare = *new SpareArenas;
  return spare;
}

/// The arena of a thread, kept for its next team.
class OwnArena {
public:
  OwnArena() = default;
  OwnArena(const OwnArena&) = delete;
  OwnArena& operator=(const OwnArena&) = delete;
  ~OwnArena() { leave(); }

  Arena& of(int count)
  {
    if (!arena_ || arena_->max_concurrency() != count) {
      leave();
      arena_ = spareArenas().take(count);
    }
    return *arena_;
  }

private:
  void leave() noexcept
  {
    if (!arena_)
      return;
    try {
      spareArenas().keep(std::move(arena_));
    }
    catch (...) { // no memory to keep it
      arena_.reset();
    }
  }

  std::unique_ptr<Arena> arena_;
};

Arena& helpersOfThisThread(int count)
{
  thread_local OwnArena own;
  return own.of(count);
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

void ThreadTeam::run(int parts, const void* work, Call call, Order order)
{
  team_of_this_thread = nullptr; // what work asks for runs one by one
  struct Return {
    ThreadTeam* team;
    ~Return() { team_of_this_thread = team; }
  } back{this};
  if (static_cast<std::uint64_t>(parts) <= Board::MOST_PARTS)
    board_->run(parts, work, call, order);
  else // of a size that no image has
    for (int part = 0; part < parts; ++part)
      call(work, part);
}

ThreadTeam* ThreadTeam::ofThisThread()
{
  return team_of_this_thread;
}

ThreadScope::ThreadScope(unsigned int threads)
: threads_(threads)
, team_(threads == 1 ? nullptr : std::make_unique<ThreadTeam>(threads))
{}

ThreadScope::~ThreadScope() = default;

void ThreadScope::run(int parts, const void* work,
                      void (*call)(const void* work, int part)) const
{
  parallelParts(parts, threads_, [&](int part) { call(work, part); });
}

} // namespace pcl_mrf_planes
