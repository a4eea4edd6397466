// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>

#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief A text option, whose value is checked by us: Boost's messages name no range. */
boost::program_options::typed_value<std::string>* text(const std::string& argument);

/** \brief Read the command line; words that are no options go to "files".
 *
 * Long options only, none abbreviated, and -h: -1 is a number.
 *
 * \throws UsageError for a word like -x, boost::program_options::error for others
 */
void readCommandLine(int argc, const char* const argv[],
                     const boost::program_options::options_description& options,
                     boost::program_options::variables_map& values);

/** \brief The words that are no options, in their order. */
std::vector<std::string>
givenFiles(const boost::program_options::variables_map& values);

/** \brief The value of a text option; empty when it was not given.
 * \throws UsageError when it was given an empty one */
std::string given(const boost::program_options::variables_map& values,
                  const char* name);

/** \brief Whether two names mean the same file. */
bool sameFile(const std::string& a, const std::string& b);

/** \brief Check that no two outputs are the same file.
 * \param[in] outputs what each is called in messages, and its name or nothing
 * \throws UsageError */
void checkDifferent(const std::vector<std::pair<std::string, std::string>>& outputs);

} // namespace pcl_mrf_planes::apps
