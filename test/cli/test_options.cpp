// SPDX-License-Identifier: BSD-3-Clause
// The command line and the configuration file.
#include "cli_test.h"
#include "two_planes.h"

#include <nlohmann/json.hpp>

namespace pcl_mrf_planes::test {

namespace {

using Json = nlohmann::json;

const std::vector<std::string> OPTIONS = {"models",
                                          "label-image",
                                          "overlay",
                                          "format",
                                          "config",
                                          "profile",
                                          "repeat",
                                          "timing",
                                          "quiet",
                                          "help",
                                          "version",
                                          "tile-width",
                                          "tile-height",
                                          "fit",
                                          "noise",
                                          "noise-multiplier",
                                          "min-valid-share",
                                          "depth",
                                          "beta",
                                          "merge-threshold",
                                          "max-planes",
                                          "lambda",
                                          "tau",
                                          "smoothness",
                                          "gamma",
                                          "iterations",
                                          "convergence-tolerance",
                                          "energy",
                                          "min-inliers",
                                          "threads"};

/// Every parameter with a value that is not its default, as the JSON shows it.
const std::vector<std::pair<std::string, Json>> VALUES = {
    {"tile-width", 16},
    {"tile-height", 12},
    {"fit", "geometric"},
    {"noise", "0.002,0.0005,0.001"},
    {"noise-multiplier", 2.5},
    {"min-valid-share", 0.25},
    {"depth", "range"},
    {"beta", 0.75},
    {"merge-threshold", 0.05},
    {"max-planes", 17},
    {"lambda", 1.5},
    {"tau", 0.125},
    {"smoothness", "predicted-depth"},
    {"gamma", 0.3},
    {"iterations", 7},
    {"convergence-tolerance", 1e-05},
    {"min-inliers", 30},
    {"threads", 2}};

std::string textOf(const Json& value)
{
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string keyOf(std::string name)
{
  for (char& c : name)
    c = c == '-' ? '_' : c;
  return name;
}

} // namespace

class CommandLine : public CliTest {
protected:
  void SetUp() override
  {
    CliTest::SetUp();
    TwoPlanes().write(path("in.pcd"), "binary");
  }

  Json reportOf(std::vector<std::string> options) const
  {
    options.insert(options.begin(), {path("in.pcd"), "--models", path("m.json")});
    const Outcome outcome = segment(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? Json::parse(read("m.json")) : Json();
  }
};

TEST_F(CommandLine, HelpNamesEveryOption)
{
  const Outcome outcome = segment({"--help"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const std::string& option : OPTIONS)
    EXPECT_NE(outcome.out.find("--" + option + " "), std::string::npos) << option;
  for (const char* word : {"(default: 40)", "(default: kinect)", "structured_light",
                           "predicted-depth", "geometric", "Exit status"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
  EXPECT_EQ(segment({"-h"}).out, outcome.out);
}

TEST_F(CommandLine, VersionIsANumber)
{
  const Outcome outcome = segment({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out.find("pcl_mrf_plane_segmentation "), 0u);
  EXPECT_NE(outcome.out.find('.'), std::string::npos);
}

TEST_F(CommandLine, EveryParameterIsAnOption)
{
  std::vector<std::string> options = {"--energy"};
  for (const auto& value : VALUES)
    options.insert(options.end(), {"--" + value.first, textOf(value.second)});
  const Json parameters = reportOf(options)["parameters"];
  for (const auto& value : VALUES)
    EXPECT_EQ(parameters[keyOf(value.first)], value.second) << value.first;
  EXPECT_EQ(parameters["energy"], true);
  EXPECT_EQ(parameters.size(), VALUES.size() + 2) << "energy, profile and these";
}

TEST_F(CommandLine, AConfigurationFileIsTheSameAsOptions)
{
  std::vector<std::string> options = {"--energy"};
  std::string file =
      "# a comment\nenergy = true\nlabel-image = " + path("c.png") + "\n";
  for (const auto& value : VALUES) {
    options.insert(options.end(), {"--" + value.first, textOf(value.second)});
    file += value.first + " = " + textOf(value.second) + "\n";
  }
  write("options.ini", file);
  const Json by_options = reportOf(options);
  const Json by_file = reportOf({"--config", path("options.ini")});
  EXPECT_EQ(by_file, by_options);
  EXPECT_EQ(files().count("c.png"), 1u) << "files can be named there, too";
}

TEST_F(CommandLine, WinsOverTheConfigurationFile)
{
  write("options.ini", "beta=0.9\ntau=0.2\n");
  const Json parameters =
      reportOf({"--config", path("options.ini"), "--beta", "0.1"})["parameters"];
  EXPECT_EQ(parameters["beta"], 0.1);
  EXPECT_EQ(parameters["tau"], 0.2);
}

TEST_F(CommandLine, NoiseIsAPresetMetresOrCoefficients)
{
  for (const char* value :
       {"kinect", "structured_light", "time_of_flight", "lidar", "none"})
    EXPECT_EQ(reportOf({"--noise", value})["parameters"]["noise"],
              value == std::string("lidar") ? Json("lidar") : Json(value));
  EXPECT_EQ(reportOf({"--noise", "0.015"})["parameters"]["noise"], 0.015);
  EXPECT_EQ(reportOf({"--noise=0.01,0,-1e-4"})["parameters"]["noise"],
            "0.01,0,-0.0001");
}

TEST_F(CommandLine, TakesNegativeNumbers)
{
  const Json report = reportOf({"--convergence-tolerance", "-2.5"});
  EXPECT_EQ(report["parameters"]["convergence_tolerance"], -2.5);
}

TEST_F(CommandLine, NumbersDoNotDependOnTheLocale)
{
  const Json plain = reportOf({"--beta", "0.25"});
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
    const Outcome outcome =
        run(PCL_MRF_PLANES_SEGMENTATION_APP,
            {path("in.pcd"), "--models", path("m.json"), "--beta", "0.25"},
            {{"LC_ALL", locale}, {"LANG", locale}});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(Json::parse(read("m.json")), plain);
  }
}

TEST_F(CommandLine, WrongUseIsStatusTwoAndOneLineThatHelps)
{
  struct Case {
    std::vector<std::string> options;
    std::string message;
  };
  const std::string in = path("in.pcd");
  const std::string out = path("out.pcd");
  write("unknown.ini", "no-such-option=1\n");
  write("nonsense.ini", "just words\n");
  const std::vector<Case> cases = {
      {{}, "no input file"},
      {{in}, "nothing to write"},
      {{in, out, "third.pcd"}, "too many files"},
      {{in, out, "--no-such-option"}, "no-such-option"},
      {{in, out, "--tile-wid", "20"}, "tile-wid"},
      {{in, out, "-beta", "1"}, "-beta"},
      {{in, out, "--beta"}, "beta"},
      {{in, out, "--beta", "much"}, "'much'"},
      {{in, out, "--beta", "1,5"}, "'1,5'"},
      {{in, out, "--beta", "nan"}, "'nan'"},
      {{in, out, "--beta", "1e999"}, "'1e999'"},
      {{in, out, "--beta="}, "beta"},
      {{in, out, "--beta", "-1"}, "--beta is -1; choose a value from 0"},
      {{in, out, "--beta", "1", "--beta", "2"}, "beta"},
      {{in, out, "--tile-width", "1"}, "--tile-width is 1; choose a value from 2"},
      {{in, out, "--tile-width", "10.5"}, "'10.5'"},
      {{in, out, "--tile-width", "99999999999"}, "whole number"},
      {{in, out, "--min-valid-share", "1.5"}, "from 0 to 1"},
      {{in, out, "--threads", "-1"}, "from 0 to 1024"},
      {{in, out, "--repeat", "0"}, "from 1 to"},
      {{in, out, "--fit", "best"}, "algebraic, geometric"},
      {{in, out, "--depth", "y"}, "auto, z, range"},
      {{in, out, "--smoothness", "strong"}, "potts, dissimilarity"},
      {{in, out, "--profile", "fastest"}, "paper"},
      {{in, out, "--format", "ply"}, "ascii, binary, binary_compressed"},
      {{in, out, "--noise", "loud"}, "kinect"},
      {{in, out, "--noise", "1,2"}, "a,b,c"},
      {{in, out, "--noise", "1,2,3,"}, "a,b,c"},
      {{in, out, "--noise", "-0.01"}, "--noise"},
      {{in, out, "--config", path("none.ini")}, "none.ini"},
      {{in, out, "--config", path("unknown.ini")}, "no-such-option"},
      {{in, out, "--config", path("nonsense.ini")}, "nonsense.ini"},
      {{in, out, "--models", out}, "same file"},
      {{in, "--overlay", in}, "overwrite the input"}};
  const auto before = files();
  for (const Case& wrong : cases) {
    const Outcome outcome = segment(wrong.options);
    EXPECT_EQ(outcome.status, 2) << wrong.message << "\n" << outcome.err;
    EXPECT_EQ(outcome.err.find("pcl_mrf_plane_segmentation: "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(wrong.message), std::string::npos)
        << "expected '" << wrong.message << "' in: " << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1)
        << "more than one line: " << outcome.err;
    EXPECT_EQ(outcome.out, "") << wrong.message;
    EXPECT_EQ(files(), before) << wrong.message << ": a file was left";
  }
}

} // namespace pcl_mrf_planes::test
