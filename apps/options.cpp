// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include "command_line.h"
#include "input_options.h"
#include "parameter_file.h"

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
       "labels")                                                                   //
      ("masks", text("FOLDER"), "write a picture for each plane into this folder") //
      ("figure", text("FILE.png"),
       "write a picture of two rows, colour, depth, labels: profile paper, and profile "
       "default under it") //
      ("stages", text("FOLDER"),
       "write pictures of the tiles and of the labels after every stage and iteration, "
       "and tables of tiles and energies, into this folder")                       //
      ("ply", text("FILE.ply"), "write the points in the colours of their labels") //
      ("format", text("ascii|binary|binary_compressed"),
       "encoding of OUT.pcd (default: that of IN, or binary_compressed)") //
      ("config", text("FILE"),
       "take options from a file with lines name=value; the command line wins") //
      ("parameters", text("FILE"),
       "take profile and parameters from a file with lines NAME = VALUE, as the next "
       "option writes it; other options win") //
      ("save-parameters", text("FILE"),
       "write the parameters in use; no input is needed for it");
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
      .add(inputOptions())
      .add(batchOptions())
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

io::PcdFormat parseFormat(const std::string& name)
{
  using io::PcdFormat;
  for (const PcdFormat format :
       {PcdFormat::ASCII, PcdFormat::BINARY, PcdFormat::BINARY_COMPRESSED})
    if (name == io::formatName(format))
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

/// Values that the options start from: a file's, or the profile's.
void startParameters(const po::variables_map& values, Options& options)
{
  const std::string path = given(values, "parameters");
  if (path.empty()) {
    options.parameters = Parameters::fromProfile(profileFromName(options.profile));
    return;
  }
  const ParameterSet set = readParameterFile(path, given(values, "profile"));
  options.profile = set.profile;
  options.parameters = set.parameters;
}

void readParameters(const po::variables_map& values, Options& options)
{
  startParameters(values, options);
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
      {"--overlay", options.overlay},
      {"--ply", options.ply},
      {"--figure", options.figure},
      {"--save-parameters", options.save_parameters}};
  for (const auto& file : options.regions.files())
    outputs.push_back(file);
  for (std::size_t i = 1; i < outputs.size(); ++i)
    if (sameFile(outputs[i].second, options.inputs[0]))
      throw UsageError(outputs[i].first + " would overwrite the input '" +
                       options.inputs[0] + "'; name another file");
  checkDifferent(outputs);
}

/// The lines of a file that are neither empty nor comments.
std::vector<std::string> readInputs(const std::string& path)
{
  std::error_code error;
  std::ifstream stream(path);
  if (!stream || std::filesystem::is_directory(path, error))
    throw UsageError("--inputs-from: cannot read '" + path + "'; check its name");
  std::vector<std::string> inputs;
  for (std::string line; std::getline(stream, line);)
    if (!line.empty() && line[0] != '#')
      inputs.push_back(line);
  return inputs;
}

/// Of a batch all files are inputs, and its folder takes all outputs.
void readBatchInputs(const std::vector<std::string>& files, Options& options)
{
  options.inputs = files;
  if (!options.batch.inputs_from.empty())
    for (std::string& input : readInputs(options.batch.inputs_from))
      options.inputs.push_back(std::move(input));
  if (options.inputs.empty())
    throw UsageError("no input; name files, folders or patterns, see --help");
  for (const auto& output :
       {std::make_pair("models", options.models),
        std::make_pair("polygons", options.regions.polygons),
        std::make_pair("confidence-image", options.regions.confidence_image),
        std::make_pair("rest", options.regions.rest),
        std::make_pair("label-image", options.label_image),
        std::make_pair("overlay", options.overlay),
        std::make_pair("figure", options.figure),
        std::make_pair("stages", options.stages),
        std::make_pair("masks", options.masks), std::make_pair("ply", options.ply)})
    if (!output.second.empty())
      throw UsageError(std::string("--") + output.first +
                       " is for a single frame; choose the files of many by --write");
}

void readFileNames(const po::variables_map& values, Options& options)
{
  const std::vector<std::string> files = givenFiles(values);
  options.models = given(values, "models");
  options.label_image = given(values, "label-image");
  options.overlay = given(values, "overlay");
  options.masks = given(values, "masks");
  options.ply = given(values, "ply");
  options.figure = given(values, "figure");
  options.stages = given(values, "stages");
  options.save_parameters = given(values, "save-parameters");
  if (options.onlySavesParameters(files.size()))
    return;
  if (options.batch.active())
    return readBatchInputs(files, options);
  if (files.empty())
    throw UsageError("no input file; usage: IN.pcd OUT.pcd [options], see --help");
  if (files.size() > 2)
    throw UsageError("too many files, from '" + files[2] +
                     "' on; give --output-folder for many, see --help");
  options.inputs = {files[0]};
  if (files.size() == 2)
    options.output = files[1];
  if (options.output.empty() && options.models.empty() && options.label_image.empty() &&
      options.overlay.empty() && options.masks.empty() && options.ply.empty() &&
      options.save_parameters.empty() && options.figure.empty() &&
      options.stages.empty() && !options.timing && !options.regions.writesFiles())
    throw UsageError(
        "nothing to write; name OUT.pcd, or give --models, --label-image, "
        "--overlay, --figure, --stages, --masks, --ply, --timing or --output-folder");
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
    options.read = readInputOptions(values);
    options.wrap = values["wrap"].as<bool>();
    options.batch = readBatchOptions(values);
    readParameters(values, options);
    options.regions = readRegionOptions(values);
    if (options.wrap && options.regions.any())
      throw UsageError("--wrap has only labels and planes to give; leave out " +
                       std::string("patches, outlines, creases, confidence, --project "
                                   "and --rest"));
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
  text << "Usage: pcl_mrf_plane_segmentation IN [OUT.pcd] [options]\n"
          "       pcl_mrf_plane_segmentation IN... --output-folder FOLDER [options]\n\n"
          "Segments organized point clouds and depth images into planes. IN is a PCD,\n"
          "PLY or PCLZF file, a 16-bit depth image, or with --output-folder also a\n"
          "folder or data set (doc/inputs.md). OUT.pcd is the same cloud with a field\n"
          "label: 0 no plane, k the k-th largest plane. Coordinates are in metres. It\n"
          "may be the input file, and may be left out when another output is asked\n"
          "for.\n\n"
       << allVisible()
       << "\nExit status: 0 success, 1 a file cannot be read, segmented or written,\n"
          "2 wrong options, 3 some frames of many failed, 130 interrupted.\n";
  return text.str();
}

} // namespace pcl_mrf_planes::apps
