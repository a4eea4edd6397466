// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <thread>

namespace pcl_mrf_planes {

/// Waits for what other threads are about to do, and now and then lets another one have the
/// core: those threads may need it.
class Patience {
public:
  void wait()
  {
    if (looks_ < MOST)
      ++looks_;
    else
      std::this_thread::yield();
  }

private:
  static constexpr int MOST = 1000; ///< looks at once
  int looks_ = 0;
};

/// The number of threads that a setting asks for; 0 means as many as there are cores.
int threadCount(unsigned int setting);

/** \brief Threads that help the one that made the team, as long as it exists.
 *
 * A cloud is segmented in some twenty parallel pieces of a tenth of a millisecond each: to
 * wake threads for every one of them would take longer than it saves. They are woken once
 * and look out for work until the team ends. The maker does every part that no helper has
 * taken, so that helpers that come late, or never, cost nothing.
 *
 * Teams of the same thread do not nest: the outer one stays. */
class ThreadTeam {
public:
  using Call = void (*)(const void* work, int part);

  /// Whether the parts of a job must be begun one after the other, or in any order.
  enum class Order { FORWARD, ANY };

  /// \param[in] threads 0: as many as there are cores; 1: no team
  explicit ThreadTeam(unsigned int threads);
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;
  ~ThreadTeam();

  /// Calls call(work, part) for every part. Not from within itself: that runs one by one.
  void run(int parts, const void* work, Call call, Order order = Order::ANY);

  /// The team that the calling thread has made and that is not at work; else null.
  static ThreadTeam* ofThisThread();

private:
  class Board;
  std::shared_ptr<Board> board_; ///< the helpers' too
};

} // namespace pcl_mrf_planes
