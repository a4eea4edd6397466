// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::test {

/** \brief What a program left behind. */
struct Outcome {
  int status = -1; ///< exit status; 128 + signal when it was killed; -1: not started
  std::string out; ///< standard output
  std::string err; ///< standard error
};

/** \brief Run a program to its end.
 * \param[in] program its path
 * \param[in] arguments without the program's name
 * \param[in] scratch folder for the files that take its output
 * \param[in] environment variables to set, over those of this process
 */
Outcome runProcess(const std::string& program,
                   const std::vector<std::string>& arguments,
                   const std::string& scratch,
                   const std::vector<std::pair<std::string, std::string>>& environment);

} // namespace pcl_mrf_planes::test
