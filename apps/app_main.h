// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Name of an app, and what to do when its memory does not suffice. */
struct AppName {
  std::string program;
  std::string when_out_of_memory;
};

/** \brief What main() of every app does around its work: what is thrown becomes a message
 * behind the program's name, and what was printed must arrive.
 *
 * \return what \a work returns; 2 after a UsageError, 1 after another exception and when
 *         standard output cannot be written
 */
int runApp(const AppName& name, const std::function<int()>& work);

} // namespace pcl_mrf_planes::apps
