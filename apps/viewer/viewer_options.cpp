// SPDX-License-Identifier: BSD-3-Clause
#include "viewer_options.h"

#include "command_line.h"
#include "input_options.h"
#include "option_values.h"
#include "parameter_file.h"
#include "parameter_options.h"

#include <boost/program_options.hpp>

#include <sstream>

namespace pcl_mrf_planes::viewer {

namespace po = boost::program_options;
using apps::given;
using apps::UsageError;

namespace {

constexpr int SMALLEST = 64; // pixels
constexpr int LARGEST = 8192;

po::options_description viewOptions()
{
  po::options_description view("View");
  view.add_options() //
      ("screenshot", apps::text("FILE.png"),
       "write a picture and show no window; works without a display where xvfb is") //
      ("film", apps::text("FOLDER"),
       "write a picture of every frame and show no window; with the key a among --keys "
       "of every step of the algorithm") //
      ("keys", apps::text("KEYS"),
       "press these keys first, a blank between two: \"c n i\"")              //
      ("window", apps::text("WIDTHxHEIGHT"), "in pixels (default: 1280x800)") //
      ("pictures", apps::text("NAME"),
       "the key for a picture writes NAME_1.png, NAME_2.png, ... (default: view)") //
      ("profile", apps::text(apps::join(apps::profileNames(), "|")),
       "values that the parameters start from (default: default)") //
      ("parameters", apps::text("FILE"),
       "take profile and parameters from a file of pcl_mrf_plane_segmentation; the "
       "keys "
       "w and e write and read it")                                       //
      ("log", po::bool_switch(), "print what is seen after every action") //
      ("help", po::bool_switch(), "print this help (also -h)")            //
      ("version", po::bool_switch(), "print the version");
  return view;
}

po::options_description allOptions()
{
  po::options_description all;
  all.add(viewOptions()).add(apps::inputOptions());
  return all;
}

std::vector<std::string> readKeys(const std::string& text)
{
  std::vector<std::string> keys;
  std::istringstream words(text);
  for (std::string key; words >> key;) {
    if (!actionOfKey(key))
      throw UsageError("--keys: '" + key + "' does nothing; see the keys in --help");
    keys.push_back(key);
  }
  return keys;
}

void readWindow(const std::string& text, WindowOptions& window)
{
  if (text.empty())
    return;
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos)
    throw UsageError("--window is '" + text + "'; give width and height, as 1280x800");
  window.width = apps::parseInteger("window", text.substr(0, cross), SMALLEST, LARGEST);
  window.height =
      apps::parseInteger("window", text.substr(cross + 1), SMALLEST, LARGEST);
}

void readParameters(const po::variables_map& values, ViewerOptions& options)
{
  const std::string profile = given(values, "profile");
  apps::ParameterSet set;
  options.parameter_file = given(values, "parameters");
  if (!options.parameter_file.empty())
    set = apps::readParameterFile(options.parameter_file, profile);
  else {
    if (!profile.empty())
      set.profile = profile;
    set.parameters = Parameters::fromProfile(apps::profileFromName(set.profile));
  }
  options.profile = apps::profileFromName(set.profile);
  options.parameters = set.parameters;
}

void readView(const po::variables_map& values, ViewerOptions& options)
{
  options.screenshot = given(values, "screenshot");
  options.film = given(values, "film");
  options.keys = readKeys(given(values, "keys"));
  readWindow(given(values, "window"), options.window);
  const std::string pictures = given(values, "pictures");
  if (!pictures.empty())
    options.window.pictures = pictures;
  options.window.log = values["log"].as<bool>();
  options.window.off_screen = !options.screenshot.empty() || !options.film.empty();
  if (values["wrap"].as<bool>())
    throw UsageError("--wrap is for pcl_mrf_plane_segmentation; leave it out");
}

} // namespace

ViewerOptions parseViewerOptions(int argc, const char* const argv[])
{
  ViewerOptions options;
  po::variables_map values;
  try {
    apps::readCommandLine(argc, argv, allOptions(), values);
    options.help = values["help"].as<bool>();
    options.version = values["version"].as<bool>();
    if (options.help || options.version)
      return options;
    options.read = apps::readInputOptions(values);
    readParameters(values, options);
    readView(values, options);
    options.inputs = apps::givenFiles(values);
    if (options.inputs.empty())
      throw UsageError("no input; name files, folders or patterns, see --help");
  }
  catch (const po::error& problem) {
    throw UsageError(std::string(problem.what()) + "; see --help");
  }
  return options;
}

std::string viewerHelp()
{
  std::ostringstream text;
  text
      << "Usage: pcl_mrf_plane_viewer IN... [options]\n\n"
         "Shows organized clouds and depth images segmented into planes. IN is a file, "
         "a\nfolder or a data set (doc/inputs.md); many frames are a sequence.\n\n"
      << allOptions()
      << "\nMouse: left turns and picks a point, middle moves, right or wheel zooms.\n"
         "Keys:\n"
      << keyHelp()
      << "\nExit status: 0 success, 1 a file cannot be read or written or there is no\n"
         "display, 2 wrong options.\n";
  return text.str();
}

} // namespace pcl_mrf_planes::viewer
