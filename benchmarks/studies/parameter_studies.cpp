// SPDX-License-Identifier: BSD-3-Clause
#include "named_parameters.h"
#include "studies.h"

#include "parameter_options.h"

#include <cmath>
#include <locale>
#include <set>
#include <sstream>

namespace pcl_mrf_planes::benchmarks {

namespace {

/// What the tables call a capability that is off, and how it is switched off.
struct Ablation {
  const char* name;
  NamedValues values;
};

const std::vector<Ablation>& ablations()
{
  static const std::vector<Ablation> all = {
      {"default", {}},
      // Noise
      {"stated noise", {{"noise", "kinect"}}},
      {"same noise for all sizes", {{"max-growth", "1"}, {"long-range", "1"}}},
      {"same noise everywhere", {{"max-local", "1"}}},
      {"exactly flat planes", {{"flatness", "0"}}},
      {"as much bend without noise", {{"quiet-flatness", "1"}}},
      // Tiles
      {"tiles of 16 points only", {{"levels", "3"}, {"smallest-level", "2"}}},
      {"tiles of 32 points only", {{"levels", "4"}, {"smallest-level", "3"}}},
      // Merging
      {"coplanar parts stay apart", {{"join-coplanar", "false"}}},
      {"joined over cracks only", {{"join-over-occluders", "false"}}},
      // Random field
      {"every point on a plane", {{"none-cost", "50"}}},
      {"planes compete everywhere", {{"support-reach", "512"}}},
      {"no smoothness", {{"label-change", "0"}}},
      {"smoothness blind to edges", {{"min-weight", "1"}}},
      {"no passes", {{"passes", "0"}}},
      {"2 passes", {{"passes", "2"}}},
      {"10 passes", {{"passes", "10"}}},
      {"cells are not labelled first", {{"rounds", "1"}}},
      {"cells are labelled twice", {{"rounds", "3"}}},
      {"every second point and row", {{"sampling", "2"}}},
      // What is no plane
      {"curved surfaces stay", {{"fan-parts", "0"}, {"bend-angle", "360"}}},
      {"surrounded facets stay", {{"fan-ring", "2"}}},
      {"no evidence needed", {{"min-evidence", "0"}}}};
  return all;
}

/// Six digits: 0.6 rather than 0.6000000000000001.
std::string shortText(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

/// Whether the defaults with this value can be used.
bool isPossible(const apps::ParameterOption& option, const std::string& text)
{
  Parameters parameters;
  try {
    option.parse(parameters, text);
  }
  catch (const apps::UsageError&) { // out of the parameter's own range
    return false;
  }
  return parameters.validate().empty();
}

/// Other values of a parameter, as text; none if it is no number, or 0.
std::vector<std::string> otherValues(const apps::ParameterOption& option)
{
  const Parameters defaults;
  const std::string text = option.print(defaults);
  double value = 0.0;
  std::vector<std::string> values;
  if (!apps::parseNumber(text, value) || value == 0.0)
    return values;
  const bool whole = option.argument == "COUNT" || option.argument == "POINTS" ||
                     option.argument == "TILES" || option.argument == "4 POINTS" ||
                     option.argument == "STEP";
  std::set<std::string> tried = {text};
  for (const double factor : {0.25, 0.5, 0.8, 1.25, 2.0, 4.0}) {
    const std::string other =
        shortText(whole ? std::round(factor * value) : factor * value);
    if (tried.insert(other).second && isPossible(option, other))
      values.push_back(other);
  }
  return values;
}

} // namespace

std::vector<Variant> ablationVariants()
{
  std::vector<Variant> variants;
  for (const Ablation& ablation : ablations())
    variants.push_back(variantOf(ablation.name, ablation.values));
  return variants;
}

std::vector<Variant> sensitivityVariants()
{
  std::vector<Variant> variants = {variantOf("default", {})};
  for (const apps::ParameterOption& option : apps::parameterOptions(Method::ADAPTIVE))
    for (const std::string& value : otherValues(option)) {
      const std::string name =
          option.name + ' ' + value + " instead of " + option.print(Parameters());
      variants.push_back(variantOf(name, {{option.name, value}}));
    }
  return variants;
}

} // namespace pcl_mrf_planes::benchmarks
