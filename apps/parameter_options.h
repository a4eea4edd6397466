// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "option_values.h"

#include <pcl_mrf_planes/parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief One value of Parameters as an option: text in, text out. */
struct ParameterOption {
  std::string name;     ///< without the dashes
  std::string argument; ///< what to give, for the help; empty: a switch
  std::string help;     ///< effect and unit
  std::function<void(Parameters&, const std::string&)> parse; ///< throws UsageError
  /// What parse() takes to get the same value.
  std::function<std::string(const Parameters&)> print;
};

/** \brief Options that every method takes. */
const std::vector<ParameterOption>& commonParameterOptions();

/** \brief Options that one method takes and the other does not. */
const std::vector<ParameterOption>& parameterOptions(Method method);

/** \brief Names of the profiles, and the profile of a name.
 * \throws UsageError for an unknown name */
std::vector<std::string> profileNames();
Profile profileFromName(const std::string& name);

/** \brief Parameters::validate(), in the words of the options.
 * \throws UsageError */
void checkParameters(const Parameters& parameters);

} // namespace pcl_mrf_planes::apps
