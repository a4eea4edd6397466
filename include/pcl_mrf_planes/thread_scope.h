// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <memory>

namespace pcl_mrf_planes {

class ThreadTeam;

/** \brief As long as it exists, threads wait for what the thread that made it has to share.
 *
 * To wake threads takes about a tenth of a millisecond. Each function of this library that
 * takes a number of threads wakes them by itself; where several follow each other, a scope
 * around them wakes them once. They take up cores as long as the scope exists. Results are
 * the same with and without. */
class PCL_MRF_PLANES_EXPORT ThreadScope {
public:
  /** \param[in] threads 0: as many as there are cores; 1: none but the caller */
  explicit ThreadScope(unsigned int threads);
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;
  ~ThreadScope();

  /** \brief Calls work(part) for every part below \a parts, by all threads of the scope
   * where the calling one made it. Parts must not depend on each other. What one of them
   * throws is thrown again here, after all of them.
   * \param[in] parts how many, >= 0
   * \param[in] work what is to be done, any number of it at once */
  template <typename Work>
  void share(int parts, const Work& work) const
  {
    run(parts, &work,
        [](const void* what, int part) { (*static_cast<const Work*>(what))(part); });
  }

private:
  void run(int parts, const void* work, void (*call)(const void* work, int part)) const;

  unsigned int threads_;
  std::unique_ptr<ThreadTeam> team_;
};

} // namespace pcl_mrf_planes
