// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_options.h"

#include <pcl_mrf_planes/parameter_table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace pcl_mrf_planes::apps {

namespace {

template <typename Enum>
using Names = std::vector<std::pair<std::string, Enum>>;

template <typename Enum>
std::vector<std::string> words(const Names<Enum>& names)
{
  std::vector<std::string> result;
  for (const auto& name : names)
    result.push_back(name.first);
  return result;
}

template <typename Enum>
Enum parseName(const std::string& option, const std::string& text,
               const Names<Enum>& names)
{
  for (const auto& name : names)
    if (name.first == text)
      return name.second;
  throw UsageError("--" + option + " is '" + text + "'; choose one of " +
                   join(words(names)));
}

const Names<Profile> PROFILES = {
    {"default", Profile::DEFAULT}, {"fast", Profile::FAST}, {"paper", Profile::PAPER}};

NoiseModel parseNoise(const std::string& option, const std::string& text)
{
  NoiseModel model;
  if (NoiseModel::fromName(text, model))
    return model;
  std::vector<double> numbers;
  std::istringstream parts(text);
  double value = 0.0;
  for (std::string part; std::getline(parts, part, ',');)
    if (parseNumber(part, value) && std::isfinite(value))
      numbers.push_back(value);
    else
      break;
  const auto commas =
      static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (numbers.size() == 1 && commas == 0)
    return NoiseModel::fixed(numbers[0]);
  if (numbers.size() == 3 && commas == 2)
    return {numbers[0], numbers[1], numbers[2]};
  throw UsageError("--" + option + " is '" + text + "'; choose one of " +
                   join(NoiseModel::names()) +
                   ", or give metres (0.01) or coefficients a,b,c (0.001,0,0.0014)");
}

std::string printNoise(const NoiseModel& noise)
{
  for (const std::string& name : NoiseModel::names()) {
    NoiseModel preset;
    if (NoiseModel::fromName(name, preset) && preset.a == noise.a &&
        preset.b == noise.b && preset.c == noise.c)
      return name;
  }
  if (noise.b == 0.0 && noise.c == 0.0)
    return printReal(noise.a);
  return printReal(noise.a) + ',' + printReal(noise.b) + ',' + printReal(noise.c);
}

/// Choices as people say them: true comes first.
std::vector<std::string> namesOf(const ParameterEntry& entry)
{
  std::vector<std::string> names = entry.choices;
  if (!names.empty() && names.front() == "false")
    std::reverse(names.begin(), names.end());
  return names;
}

void checkRange(const ParameterEntry& entry, const std::string& name, double value)
{
  if (!(value >= entry.low && value <= entry.high))
    throw UsageError("--" + name + " is " + printReal(value) +
                     "; choose a value from " + printReal(entry.low) + " to " +
                     printReal(entry.high));
}

/// Text into the value of an entry.
void parseEntry(const ParameterEntry& entry, const std::string& name,
                const std::string& text, Parameters& parameters)
{
  double value = 0.0;
  if (!entry.choices.empty()) {
    const auto found = std::find(entry.choices.begin(), entry.choices.end(), text);
    if (found == entry.choices.end())
      throw UsageError("--" + name + " is '" + text + "'; choose one of " +
                       join(namesOf(entry)));
    value = static_cast<double>(found - entry.choices.begin());
  }
  else if (entry.isWhole())
    value = parseInteger(name, text, std::numeric_limits<int>::min(),
                         std::numeric_limits<int>::max());
  else
    value = parseReal(name, text);
  checkRange(entry, name, value);
  entry.set(parameters, value);
}

/// The option of an entry of the table.
ParameterOption optionOf(const ParameterEntry& entry)
{
  std::string name = entry.name == "number_of_threads" ? "threads"
                     : entry.name == "depth_measure"   ? "depth"
                     : entry.name == "compute_energy"  ? "energy"
                                                       : entry.name;
  std::replace(name.begin(), name.end(), '_', '-');
  const bool is_switch = name == "energy"; // as an option, given or not
  const std::string argument = is_switch               ? ""
                               : entry.choices.empty() ? entry.unit
                                                       : join(namesOf(entry), "|");
  return {name, argument, entry.help,
          [&entry, name](Parameters& p, const std::string& text) {
            parseEntry(entry, name, text, p);
          },
          [&entry](const Parameters& p) { return entry.print(p); }};
}

std::vector<ParameterOption> optionsOf(ParameterUse use)
{
  std::vector<ParameterOption> options;
  for (const ParameterEntry& entry : parameterTable())
    if (entry.use == use)
      options.push_back(optionOf(entry));
  return options;
}

void setNoise(Parameters& p, const std::string& text)
{
  p.adaptive.estimate_noise = text == "auto";
  if (text == "auto" && p.method == Method::PAPER)
    throw UsageError("--noise is auto; the paper's method takes a preset, metres, or "
                     "a,b,c, see --help");
  if (text != "auto")
    p.noise = parseNoise("noise", text);
}

std::string printUsedNoise(const Parameters& p)
{
  return p.method == Method::ADAPTIVE && p.adaptive.estimate_noise
             ? "auto"
             : printNoise(p.noise);
}

/// With the noise, which is no single number, in the second place.
std::vector<ParameterOption> commonOptions()
{
  std::vector<ParameterOption> options = optionsOf(ParameterUse::ALL);
  options.insert(options.begin() + 1,
                 {"noise", "auto|NAME|METRES|A,B,C",
                  "sensor noise sigma(z): auto, estimated from the cloud (profile "
                  "default); " +
                      join(NoiseModel::names()) +
                      "; the same number of metres at every depth; or the "
                      "coefficients of a + b z + c z^2",
                  setNoise, printUsedNoise});
  return options;
}

} // namespace

const std::vector<ParameterOption>& commonParameterOptions()
{
  static const std::vector<ParameterOption> all = commonOptions();
  return all;
}

const std::vector<ParameterOption>& parameterOptions(Method method)
{
  static const std::vector<ParameterOption> paper = optionsOf(ParameterUse::PAPER);
  static const std::vector<ParameterOption> adaptive =
      optionsOf(ParameterUse::ADAPTIVE);
  return method == Method::PAPER ? paper : adaptive;
}

std::vector<std::string> profileNames()
{
  return words(PROFILES);
}

Profile profileFromName(const std::string& name)
{
  return parseName("profile", name, PROFILES);
}

void checkParameters(const Parameters& parameters)
{
  std::string complaint = parameters.validate();
  if (complaint.empty())
    return;
  // "tile_width is 1; choose ..." becomes "--tile-width is 1; choose ...".
  const std::size_t end = std::min(complaint.find(' '), complaint.size());
  std::replace(complaint.begin(), complaint.begin() + static_cast<std::ptrdiff_t>(end),
               '_', '-');
  throw UsageError("--" + complaint);
}

} // namespace pcl_mrf_planes::apps
