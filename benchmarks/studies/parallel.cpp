// SPDX-License-Identifier: BSD-3-Clause
#include "parallel.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

void doAll(std::size_t count, unsigned int threads,
           const std::function<void(std::size_t)>& job)
{
  std::atomic<std::size_t> next = 0;
  std::exception_ptr failure;
  std::mutex failing;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++)
        job(i);
    }
    catch (...) {
      const std::lock_guard<std::mutex> lock(failing);
      if (!failure)
        failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> workers;
  for (unsigned int i = 0; i < threads; ++i)
    workers.emplace_back(work);
  for (std::thread& worker : workers)
    worker.join();
  if (failure)
    std::rethrow_exception(failure);
}

} // namespace pcl_mrf_planes::benchmarks
