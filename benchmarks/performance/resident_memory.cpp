// SPDX-License-Identifier: BSD-3-Clause
#include "resident_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr std::int64_t KILOBYTE = 1024;

/// A line "NAME: 123 kB" of proc(5), in bytes; 0 when there is none such.
std::int64_t statusOf(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.compare(0, name.size() + 1, name + ':') == 0)
      return KILOBYTE * std::stoll(line.substr(name.size() + 1));
  return 0;
}

} // namespace

ResidentPeak::ResidentPeak()
{
  malloc_trim(0);                              // what earlier work left
  std::ofstream("/proc/self/clear_refs") << 5; // the peak starts anew
  start_ = statusOf("VmRSS");
}

std::int64_t ResidentPeak::bytes() const
{
  return statusOf("VmHWM") - start_;
}

} // namespace pcl_mrf_planes::benchmarks
