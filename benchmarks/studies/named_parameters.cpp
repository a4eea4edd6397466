// SPDX-License-Identifier: BSD-3-Clause
#include "named_parameters.h"

#include "ours_peer.h"
#include "parameter_options.h"

#include <algorithm>
#include <stdexcept>

namespace pcl_mrf_planes::benchmarks {

namespace {

const apps::ParameterOption& findOption(const std::string& name)
{
  const auto& options = apps::parameterOptions(Method::ADAPTIVE);
  const auto found =
      std::find_if(options.begin(), options.end(),
                   [&](const apps::ParameterOption& o) { return o.name == name; });
  if (found == options.end())
    throw std::runtime_error("there is no parameter \"" + name + '"');
  return *found;
}

} // namespace

Variant variantOf(const std::string& name, const NamedValues& values)
{
  Parameters parameters;
  for (const auto& [option, text] : values)
    findOption(option).parse(parameters, text);
  apps::checkParameters(parameters);
  return {name, [parameters](const Cloud::ConstPtr& cloud, double& milliseconds) {
            return segmentByClass(cloud, parameters, milliseconds);
          }};
}

} // namespace pcl_mrf_planes::benchmarks
