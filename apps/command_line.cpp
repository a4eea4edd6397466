// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.h"

#include "option_values.h"

#include <filesystem>
#include <system_error>

namespace pcl_mrf_planes::apps {

namespace po = boost::program_options;

namespace {

/// -h, and a word with a dash in front that is neither an option nor a number.
std::pair<std::string, std::string> parseShort(const std::string& word)
{
  if (word == "-h")
    return {"help", ""};
  const bool is_number =
      word.size() > 1 && (word[1] == '.' || (word[1] >= '0' && word[1] <= '9'));
  if (word.size() > 1 && word[0] == '-' && word[1] != '-' && !is_number)
    throw UsageError("unknown option '" + word + "'; see --help");
  return {};
}

} // namespace

po::typed_value<std::string>* text(const std::string& argument)
{
  return po::value<std::string>()->value_name(argument);
}

void readCommandLine(int argc, const char* const argv[],
                     const po::options_description& options, po::variables_map& values)
{
  po::options_description all = options;
  all.add_options()("files", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("files", -1);
  // No short options: -1 is a number. No guessing: a script must mean what it says.
  using namespace po::command_line_style;
  po::store(po::command_line_parser(argc, argv)
                .options(all)
                .positional(positional)
                .style(allow_long | long_allow_adjacent | long_allow_next)
                .extra_parser(parseShort)
                .run(),
            values);
}

std::vector<std::string> givenFiles(const po::variables_map& values)
{
  if (values.count("files") == 0)
    return {};
  return values["files"].as<std::vector<std::string>>();
}

std::string given(const po::variables_map& values, const char* name)
{
  if (values.count(name) == 0)
    return {};
  const std::string& value = values[name].as<std::string>();
  if (value.empty())
    throw UsageError(std::string("--") + name + " is empty; give a value");
  return value;
}

bool sameFile(const std::string& a, const std::string& b)
{
  std::error_code error;
  return !a.empty() && !b.empty() &&
         std::filesystem::weakly_canonical(a, error) ==
             std::filesystem::weakly_canonical(b, error);
}

void checkDifferent(const std::vector<std::pair<std::string, std::string>>& outputs)
{
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (sameFile(outputs[i].second, outputs[j].second))
        throw UsageError(outputs[j].first + " and " + outputs[i].first +
                         " name the same file '" + outputs[i].second + "'; name two");
}

} // namespace pcl_mrf_planes::apps
