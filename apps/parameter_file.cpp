// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_file.h"

#include "output_file.h"
#include "parameter_options.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <system_error>
#include <vector>

namespace pcl_mrf_planes::apps {

namespace {

struct Line {
  int number;
  std::string name, value;
};

std::string trimmed(const std::string& text)
{
  constexpr const char* BLANKS = " \t\r";
  const std::size_t begin = text.find_first_not_of(BLANKS);
  if (begin == std::string::npos)
    return {};
  return text.substr(begin, text.find_last_not_of(BLANKS) + 1 - begin);
}

[[noreturn]] void complain(const std::string& path, int line, const std::string& what)
{
  throw UsageError("'" + path + "', line " + std::to_string(line) + ": " + what);
}

std::vector<Line> readLines(const std::string& path)
{
  std::error_code error;
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path, error))
    throw UsageError("cannot read the parameter file '" + path + "'; check its name");
  std::vector<Line> lines;
  std::map<std::string, int> first;
  int number = 0;
  for (std::string text; std::getline(stream, text);) {
    ++number;
    const std::string content = trimmed(text.substr(0, text.find('#')));
    if (content.empty())
      continue;
    const std::size_t sign = content.find('=');
    if (sign == std::string::npos || sign == 0)
      complain(path, number,
               "'" + content.substr(0, 60) + "' is not NAME = VALUE; write it so");
    Line line = {number, trimmed(content.substr(0, sign)),
                 trimmed(content.substr(sign + 1))};
    const auto [before, is_new] = first.emplace(line.name, number);
    if (!is_new)
      complain(path, number,
               line.name + " stands in line " + std::to_string(before->second) +
                   " already; remove one of them");
    lines.push_back(std::move(line));
  }
  if (stream.bad())
    throw UsageError("cannot read all of the parameter file '" + path +
                     "'; check the disk");
  return lines;
}

const ParameterOption* findOption(const std::vector<ParameterOption>& options,
                                  const std::string& name)
{
  const auto found =
      std::find_if(options.begin(), options.end(),
                   [&](const ParameterOption& option) { return option.name == name; });
  return found == options.end() ? nullptr : &*found;
}

void apply(const std::string& path, const Line& line, ParameterSet& set)
{
  const Method method = set.parameters.method;
  const Method other = method == Method::PAPER ? Method::ADAPTIVE : Method::PAPER;
  const ParameterOption* option = findOption(commonParameterOptions(), line.name);
  if (option == nullptr)
    option = findOption(parameterOptions(method), line.name);
  if (option == nullptr && findOption(parameterOptions(other), line.name) != nullptr)
    complain(path, line.number,
             line.name + " has no effect in profile " + set.profile +
                 "; remove the line, or choose profile " +
                 (other == Method::PAPER ? "paper" : "default"));
  if (option == nullptr)
    complain(path, line.number,
             "there is no parameter '" + line.name.substr(0, 60) +
                 "'; see --help for their names");
  if (option->argument.empty() && line.value != "true" && line.value != "false")
    complain(path, line.number,
             line.name + " is '" + line.value + "'; choose one of true, false");
  try {
    option->parse(set.parameters, line.value);
  }
  catch (const UsageError& error) {
    complain(path, line.number, std::string(error.what()).substr(2)); // without dashes
  }
}

/// Options in the order of a file, the profile's comes before all of them.
std::vector<const ParameterOption*> optionsOf(Method method)
{
  std::vector<const ParameterOption*> all;
  for (const ParameterOption& option : commonParameterOptions())
    all.push_back(&option);
  for (const ParameterOption& option : parameterOptions(method))
    all.push_back(&option);
  return all;
}

} // namespace

ParameterSet readParameterFile(const std::string& path, const std::string& profile)
{
  const std::vector<Line> lines = readLines(path);
  ParameterSet set;
  const auto own = std::find_if(lines.begin(), lines.end(), [](const Line& line) {
    return line.name == "profile";
  });
  try {
    if (own != lines.end())
      set.profile = own->value;
    profileFromName(set.profile);
  }
  catch (const UsageError& error) {
    complain(path, own->number, std::string(error.what()).substr(2));
  }
  if (!profile.empty())
    set.profile = profile;
  set.parameters = Parameters::fromProfile(profileFromName(set.profile));
  for (const Line& line : lines)
    if (line.name != "profile")
      apply(path, line, set);
  const std::string complaint = set.parameters.validate();
  if (!complaint.empty())
    throw UsageError("'" + path + "': " + complaint);
  return set;
}

std::string parameterFileText(const ParameterSet& set)
{
  std::ostringstream text;
  text
      << "# Parameters of pcl_mrf_plane_segmentation: give them by --parameters FILE.\n"
         "profile = "
      << set.profile << '\n';
  for (const ParameterOption* option : optionsOf(set.parameters.method))
    text << "\n# " << option->help
         << (option->argument.empty() ? "" : " [" + option->argument + "]") << '\n'
         << option->name << " = " << option->print(set.parameters) << '\n';
  return text.str();
}

void writeParameterFile(const std::string& path, const ParameterSet& set)
{
  writeBytes(path, parameterFileText(set));
}

} // namespace pcl_mrf_planes::apps
