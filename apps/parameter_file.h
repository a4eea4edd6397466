// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/parameters.h>

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief What a parameter file holds: a profile, and values that start from it. */
struct ParameterSet {
  std::string profile = "default";
  Parameters parameters;
};

/** \brief Read a parameter file: lines NAME = VALUE with the names and values of the
 * options of --help without their dashes, "profile" among them; comments begin with #.
 *
 * What the file does not name has the value of its profile.
 *
 * \param[in] profile in place of the file's own; empty: the file's, or default
 * \throws UsageError with the file, the line, what is wrong and what to do
 */
ParameterSet readParameterFile(const std::string& path,
                               const std::string& profile = "");

/** \brief The text of a parameter file: all values that the method takes, each with what
 * it does, so that reading it gives the same parameters bit for bit. */
std::string parameterFileText(const ParameterSet& set);

/** \brief Write a parameter file, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeParameterFile(const std::string& path, const ParameterSet& set);

} // namespace pcl_mrf_planes::apps
