// SPDX-License-Identifier: BSD-3-Clause
#include "named_parameters.h"

#include "ours_peer.h"
#include "parameter_options.h"

#include <stdexcept>

namespace pcl_mrf_planes::benchmarks {

namespace {

const apps::ParameterOption& findOption(const std::string& name)
{
  for (const auto* options :
       {&apps::commonParameterOptions(), &apps::parameterOptions(Method::ADAPTIVE)})
    for (const apps::ParameterOption& option : *options)
      if (option.name == name)
        return option;
  throw std::runtime_error("there is no parameter \"" + name + '"');
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
