// SPDX-License-Identifier: BSD-3-Clause
#include "quiet_pcl.h"

#include <pcl/console/print.h>

#include <mutex>

namespace pcl_mrf_planes::io {

namespace {

std::mutex lock;
int count = 0;
pcl::console::VERBOSITY_LEVEL before = pcl::console::L_INFO;

} // namespace

QuietPcl::QuietPcl()
{
  const std::lock_guard<std::mutex> guard(lock);
  if (count++ > 0)
    return;
  before = pcl::console::getVerbosityLevel();
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
}

QuietPcl::~QuietPcl()
{
  const std::lock_guard<std::mutex> guard(lock);
  if (--count == 0)
    pcl::console::setVerbosityLevel(before);
}

} // namespace pcl_mrf_planes::io
