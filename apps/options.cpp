// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include "command_line.h"

#include <boost/program_options.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

namespace po = boost::program_options;

namespace {

constexpr int MOST_REPEATS = 1000000;

po::options_description fileOptions()
{
  po::options_description files("Files");
  files.add_options()                                                                //
      ("models", text("FILE.json"), "write planes, counts, parameters and times")    //
      ("label-image", text("FILE.png"), "write the labels as a 16-bit gray picture") //
      ("overlay", text("FILE.png"),
       "write a picture of three panels: colour, depth (invalid points black), "
       "labels") //
      ("format", text("ascii|binary|binary_compressed"),
       "encoding of OUT.pcd (default: that of IN.pcd)") //
      ("config", text("FILE"),
       "take options from a file with lines name=value; the command line wins");
  return files;
}

po::options_description runOptions()
{
  po::options_description run("Run");
  run.add_options() //
      ("profile", text(join(profileNames(), "|")),
       "values that the parameters below start from (default: default)")          //
      ("repeat", text("COUNT"), "segment so many times, for timing (default: 1)") //
      ("timing", po::bool_switch(),
       "print and record the median time of each stage, with least and most") //
      ("quiet", po::bool_switch(), "print nothing but errors")                //
      ("help", po::bool_switch(), "print this help (also -h)")                //
      ("version", po::bool_switch(), "print the version");
  return run;
}

po::options_description describe(const char* title,
                                 const std::vector<ParameterOption>& options)
{
  po::options_description parameters(title);
  const Parameters defaults;
  for (const ParameterOption& option : options) {
    const std::string help =
        option.help +
        " (default: " + (option.argument.empty() ? "off" : option.print(defaults)) +
        ")";
    if (option.argument.empty())
      parameters.add_options()(option.name.c_str(), po::bool_switch(), help.c_str());
    else
      parameters.add_options()(option.name.c_str(), text(option.argument),
                               help.c_str());
  }
  return parameters;
}

po::options_description allVisible()
{
  po::options_description all;
  all.add(fileOptions())
      .add(runOptions())
      .add(regionOptions())
      .add(describe("Parameters", commonParameterOptions()))
      .add(
          describe("Parameters of profile default", parameterOptions(Method::ADAPTIVE)))
      .add(describe("Parameters of profile paper", parameterOptions(Method::PAPER)));
  return all;
}

void parseConfiguration(const std::string& path, po::variables_map& values)
{
  std::error_code error;
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path, error))
    throw UsageError("cannot read the configuration file '" + path +
                     "'; check its name");
  try {
    po::store(po::parse_config_file(stream, allVisible()), values);
  }
  catch (const po::error& problem) {
    throw UsageError("configuration file '" + path + "': " + problem.what() +
                     "; lines are name=value, see --help");
  }
}

PcdFormat parseFormat(const std::string& name)
{
  for (const PcdFormat format :
       {PcdFormat::ASCII, PcdFormat::BINARY, PcdFormat::BINARY_COMPRESSED})
    if (name == formatName(format))
      return format;
  throw UsageError("--format is '" + name +
                   "'; choose one of ascii, binary, binary_compressed");
}

bool isGiven(const po::variables_map& values, const ParameterOption& option)
{
  return values.count(option.name) != 0 && !values[option.name].defaulted();
}

void readParameters(const std::vector<ParameterOption>& known,
                    const po::variables_map& values, Parameters& parameters)
{
  for (const ParameterOption& option : known) {
    if (!isGiven(values, option))
      continue;
    if (option.argument.empty())
      option.parse(parameters, values[option.name].as<bool>() ? "true" : "false");
    else
      option.parse(parameters, given(values, option.name.c_str()));
  }
}

void readParameters(const po::variables_map& values, Options& options)
{
  options.parameters = Parameters::fromProfile(profileFromName(options.profile));
  const bool paper = options.parameters.method == Method::PAPER;
  readParameters(commonParameterOptions(), values, options.parameters);
  readParameters(parameterOptions(options.parameters.method), values,
                 options.parameters);
  for (const ParameterOption& option :
       parameterOptions(paper ? Method::ADAPTIVE : Method::PAPER))
    if (isGiven(values, option))
      throw UsageError("--" + option.name + " has no effect in profile " +
                       options.profile + "; add --profile " +
                       (paper ? "default" : "paper"));
  checkParameters(options.parameters);
}

/// Files that would overwrite each other; only OUT.pcd may be the input.
void checkFileNames(const Options& options)
{
  std::vector<std::pair<std::string, std::string>> outputs = {
      {"OUT.pcd", options.output},
      {"--models", options.models},
      {"--label-image", options.label_image},
      {"--overlay", options.overlay}};
  for (const auto& file : options.regions.files())
    outputs.push_back(file);
  for (std::size_t i = 1; i < outputs.size(); ++i)
    if (sameFile(outputs[i].second, options.input))
      throw UsageError(outputs[i].first + " would overwrite the input '" +
                       options.input + "'; name another file");
  checkDifferent(outputs);
}

void readFileNames(const po::variables_map& values, Options& options)
{
  const std::vector<std::string> files = givenFiles(values);
  if (files.empty())
    throw UsageError("no input file; usage: IN.pcd OUT.pcd [options], see --help");
  if (files.size() > 2)
    throw UsageError("too many files, from '" + files[2] +
                     "' on; usage: IN.pcd OUT.pcd [options], see --help");
  options.input = files[0];
  if (files.size() == 2)
    options.output = files[1];
  options.models = given(values, "models");
  options.label_image = given(values, "label-image");
  options.overlay = given(values, "overlay");
  if (options.output.empty() && options.models.empty() && options.label_image.empty() &&
      options.overlay.empty() && !options.timing && !options.regions.writesFiles())
    throw UsageError("nothing to write; name OUT.pcd, or give --models, --label-image, "
                     "--overlay or --timing");
  checkFileNames(options);
}

} // namespace

Options parseOptions(int argc, const char* const argv[])
{
  Options options;
  po::variables_map values;
  try {
    readCommandLine(argc, argv, allVisible(), values);
    options.help = values["help"].as<bool>();
    options.version = values["version"].as<bool>();
    if (options.help || options.version)
      return options;
    const std::string configuration = given(values, "config");
    if (!configuration.empty())
      parseConfiguration(configuration, values);
    options.timing = values["timing"].as<bool>();
    options.quiet = values["quiet"].as<bool>();
    if (values.count("format") != 0)
      options.format = parseFormat(given(values, "format"));
    if (values.count("profile") != 0)
      options.profile = given(values, "profile");
    if (values.count("repeat") != 0)
      options.repeat = parseInteger("repeat", given(values, "repeat"), 1, MOST_REPEATS);
    readParameters(values, options);
    options.regions = readRegionOptions(values);
    readFileNames(values, options);
  }
  catch (const po::error& problem) {
    throw UsageError(std::string(problem.what()) + "; see --help");
  }
  return options;
}

std::string helpText()
{
  std::ostringstream text;
  text << "Usage: pcl_mrf_plane_segmentation IN.pcd [OUT.pcd] [options]\n\n"
          "Segments an organized point cloud into planes. OUT.pcd is the same cloud\n"
          "with a field label: 0 no plane, k the k-th largest plane. Coordinates are\n"
          "in metres. It may be the input file, and may be left out when another\n"
          "output is asked for.\n\n"
       << allVisible()
       << "\nExit status: 0 success, 1 a file cannot be read, segmented or written,\n"
          "2 wrong options.\n";
  return text.str();
}

} // namespace pcl_mrf_planes::apps
