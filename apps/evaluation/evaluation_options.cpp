// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_options.h"

#include "command_line.h"
#include "option_values.h"

#include <limits>
#include <sstream>

namespace pcl_mrf_planes::evaluation {

namespace po = boost::program_options;
using apps::given;
using apps::text;
using apps::UsageError;

namespace {

constexpr int FARTHEST_BORDER = 65535; // points

po::typed_value<std::vector<std::string>>* list(const std::string& argument)
{
  return po::value<std::vector<std::string>>()->value_name(argument);
}

po::options_description describe()
{
  const EvaluationOptions defaults;
  const std::string suffix_help =
      "what the names of the truth end in, after a dot; may "
      "be given several times (default: " +
      apps::join(defaults.suffixes) + ")";
  po::options_description files("Files");
  files.add_options() //
      ("truth", text("DIR"),
       "folder of ground truth NAME.SUFFIX; each folder below it "
       "is a set of its own")(
          "labels", text("DIR"),
          "folder of results NAME.png, NAME.labels.png or NAME.pcd, "
          "at the same place below it")("suffix", list("SUFFIX"), suffix_help.c_str())(
          "cloud", text("DIR"),
          "folder of clouds NAME.pcd at the same place: errors of the "
          "planes in degrees and millimetres")(
          "csv", text("FILE"), "write a line for each frame, set and mean")(
          "json", text("FILE"), "write everything");
  po::options_description scores("Scores");
  scores.add_options() //
      ("tolerance", text("SHARE"),
       "of points that must agree for a region to be "
       "correct, above 0.5, at most 1 (default: 0.8)")(
          "min-points", text("COUNT"),
          "planes with so many points or fewer are left out (default: 0)")(
          "incomplete", po::bool_switch(),
          "the truth lacks planes: no clutter is counted")(
          "border", list("POINTS"),
          "precision and recall of borders that may lie so many "
          "points off; may be given several times")(
          "curve", po::bool_switch(), "region counts at tolerances from 0.51 to 0.95");
  po::options_description run("Run");
  run.add_options() //
      ("each", po::bool_switch(), "print a line for each frame as well")(
          "quiet", po::bool_switch(), "print nothing but errors")(
          "help", po::bool_switch(), "print this help (also -h)")(
          "version", po::bool_switch(), "print the version");
  po::options_description all;
  all.add(files).add(scores).add(run);
  return all;
}

std::vector<std::string> givenList(const po::variables_map& values, const char* name)
{
  if (values.count(name) == 0)
    return {};
  const auto& words = values[name].as<std::vector<std::string>>();
  for (const std::string& word : words)
    if (word.empty())
      throw UsageError(std::string("--") + name + " is empty; give a value");
  return words;
}

void readScores(const po::variables_map& values, EvaluationOptions& options)
{
  ScoreOptions& score = options.score;
  if (values.count("tolerance") != 0) {
    const std::string tolerance = given(values, "tolerance");
    score.tolerance = apps::parseReal("tolerance", tolerance);
    if (!(score.tolerance > 0.5 && score.tolerance <= 1.0))
      throw UsageError("--tolerance is '" + tolerance +
                       "'; give a share above 0.5 and at most 1");
  }
  if (values.count("min-points") != 0)
    score.min_points = apps::parseInteger("min-points", given(values, "min-points"), 0,
                                          std::numeric_limits<int>::max());
  score.complete = !values["incomplete"].as<bool>();
  for (const std::string& distance : givenList(values, "border"))
    options.borders.push_back(
        apps::parseInteger("border", distance, 0, FARTHEST_BORDER));
}

void readFiles(const po::variables_map& values, EvaluationOptions& options)
{
  options.files = apps::givenFiles(values);
  options.truth = given(values, "truth");
  options.labels = given(values, "labels");
  options.cloud = given(values, "cloud");
  options.csv = given(values, "csv");
  options.json = given(values, "json");
  if (values.count("suffix") != 0)
    options.suffixes = givenList(values, "suffix");
}

void checkFiles(const EvaluationOptions& options)
{
  const bool folders = !options.truth.empty() || !options.labels.empty();
  if (options.files.empty() && !folders)
    throw UsageError("nothing to score; usage: TRUTH LABELS [TRUTH LABELS ...], or "
                     "--truth DIR --labels DIR, see --help");
  if (!options.files.empty() && folders)
    throw UsageError("both files and folders are given, from '" + options.files[0] +
                     "' on; give pairs of files, or --truth and --labels");
  if (folders && (options.truth.empty() || options.labels.empty()))
    throw UsageError(options.truth.empty()
                         ? "--labels needs --truth; name both folders"
                         : "--truth needs --labels; name both folders");
  if (options.files.size() % 2 != 0)
    throw UsageError("'" + options.files.back() +
                     "' has no partner; give pairs TRUTH LABELS");
  for (const std::string& file : options.files)
    for (const std::string& output : {options.csv, options.json})
      if (apps::sameFile(file, output))
        throw UsageError("'" + output +
                         "' would overwrite an input; name another file");
  apps::checkDifferent({{"--csv", options.csv}, {"--json", options.json}});
}

} // namespace

EvaluationOptions parseEvaluationOptions(int argc, const char* const argv[])
{
  EvaluationOptions options;
  try {
    po::variables_map values;
    apps::readCommandLine(argc, argv, describe(), values);
    options.help = values["help"].as<bool>();
    options.version = values["version"].as<bool>();
    if (options.help || options.version)
      return options;
    options.curve = values["curve"].as<bool>();
    options.each = values["each"].as<bool>();
    options.quiet = values["quiet"].as<bool>();
    readScores(values, options);
    readFiles(values, options);
    checkFiles(options);
  }
  catch (const po::error& problem) {
    throw UsageError(std::string(problem.what()) + "; see --help");
  }
  return options;
}

std::string evaluationHelp()
{
  std::ostringstream help;
  help << "Usage: pcl_mrf_plane_evaluation TRUTH LABELS [TRUTH LABELS ...] [options]\n"
          "       pcl_mrf_plane_evaluation --truth DIR --labels DIR [options]\n\n"
          "Scores planes against ground truth. Both are 16-bit gray PNGs of the "
          "cloud's\n"
          "size, or organized PCD files with a field label: 0 no plane, k plane k. In\n"
          "the truth 65535 is not scored.\n"
       << describe()
       << "\nNumbers, means over frames:\n"
          "  ratio            correct regions of all frames over true planes of all\n"
          "  truth            planes of the truth a frame\n"
          "  correct, over, under, missed, noise\n"
          "                   regions a frame (Hoover et al., PAMI 1996)\n"
          "  pq               panoptic quality (Kirillov et al., CVPR 2019)\n"
          "  sc               segmentation covering (Arbelaez et al., PAMI 2011)\n"
          "  ri, voi          Rand index; variation of information, nats\n"
          "  recall, clutter  share of the points on, and off, true planes that carry "
          "a\n"
          "                   plane\n"
          "\nExit status: 0 success, 1 a file cannot be read, scored or written,\n"
          "2 wrong options.\n";
  return help.str();
}

} // namespace pcl_mrf_planes::evaluation
