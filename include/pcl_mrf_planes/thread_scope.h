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

private:
  std::unique_ptr<ThreadTeam> team_;
};

} // namespace pcl_mrf_planes
