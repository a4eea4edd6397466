// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.h"

#include "output_file.h"

#include <pcl_mrf_planes/io/output_file.h>

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace pcl_mrf_planes::apps {

namespace {

constexpr int SIGNAL_STATUS = 128; // as shells count: 128 + signal

std::atomic<bool> came{false};
std::atomic<bool> finish{false};
static_assert(std::atomic<bool>::is_always_lock_free, "used in a signal handler");

extern "C" void handle(int signal)
{
  if (finish && !came.exchange(true))
    return;
  io::removePartialFiles();
  ::_exit(SIGNAL_STATUS + signal);
}

} // namespace

void takeInterruptions(OnInterruption what)
{
  finish = what == OnInterruption::FINISH;
  struct sigaction action {};
  action.sa_handler = handle;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool interrupted()
{
  return came;
}

} // namespace pcl_mrf_planes::apps
