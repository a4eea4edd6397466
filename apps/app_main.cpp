// SPDX-License-Identifier: BSD-3-Clause
#include "app_main.h"

#include "option_values.h"

#include <pcl/console/print.h>

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>

namespace pcl_mrf_planes::apps {

namespace {

constexpr int FAILURE = 1;
constexpr int WRONG_USAGE = 2;

} // namespace

int runApp(const AppName& name, const std::function<int()>& work)
{
  // What PCL would print is said by the messages below, with what to do about it.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  const auto complain = [&](const std::string& text) {
    std::cerr << name.program << ": " << text << '\n';
  };
  try {
    const int status = work();
    if (!std::cout.flush()) // a full disk shows here at the latest
      throw std::runtime_error("cannot write to standard output");
    return status;
  }
  catch (const UsageError& error) {
    complain(error.what());
    return WRONG_USAGE;
  }
  catch (const std::bad_alloc&) {
    complain("not enough memory; " + name.when_out_of_memory);
  }
  catch (const std::exception& error) {
    complain(error.what());
  }
  return FAILURE;
}

} // namespace pcl_mrf_planes::apps
