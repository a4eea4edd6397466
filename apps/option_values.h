// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief The call was wrong: exit status 2. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief The number that makes up all of the text, whatever the locale.
 * \return false if there is none, or more than it */
bool parseNumber(const std::string& text, double& value);
bool parseNumber(const std::string& text, int& value);

/** \brief A finite number from an option. \throws UsageError */
double parseReal(const std::string& option, const std::string& text);

/** \brief A whole number from an option. \throws UsageError */
int parseInteger(const std::string& option, const std::string& text, int low, int high);

/** \brief The shortest text that is the same number when read back. */
std::string printReal(double value);

/** \brief Comma and blank between words. */
std::string join(const std::vector<std::string>& words, const char* between = ", ");

} // namespace pcl_mrf_planes::apps
