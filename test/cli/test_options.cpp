// SPDX-License-Identifier: BSD-3-Clause
// The command line and the configuration file.
#include "cli_test.h"
#include "two_planes.h"

#include <nlohmann/json.hpp>

namespace pcl_mrf_planes::test {

namespace {

using Json = nlohmann::json;

/// A parameter with a value that is not its default, as the JSON shows it.
using Values = std::vector<std::pair<std::string, Json>>;

const std::vector<std::string> OTHER_OPTIONS = {
    "models",     "label-image",     "overlay", "masks",
    "ply",        "format",          "config",  "profile",
    "repeat",     "timing",          "quiet",   "help",
    "version",    "camera",          "size",    "filled-depth",
    "wrap",       "output-folder",   "write",   "inputs-from",
    "jobs",       "shard",           "resume",  "list",
    "parameters", "save-parameters", "stages",  "figure"};

const Values COMMON = {{"depth", "range"},
                       {"noise", "0.002,0.0005,0.001"},
                       {"min-inliers", 30},
                       {"min-area", 0.0625},
                       {"threads", 2}};

/// Of profile paper; --energy, a switch, comes on top.
const Values PAPER = {{"tile-width", 16},
                      {"tile-height", 12},
                      {"fit", "geometric"},
                      {"noise-multiplier", 2.5},
                      {"min-valid-share", 0.25},
                      {"beta", 0.75},
                      {"merge-threshold", 0.05},
                      {"max-planes", 17},
                      {"lambda", 1.5},
                      {"tau", 0.125},
                      {"smoothness", "predicted-depth"},
                      {"gamma", 0.3},
                      {"iterations", 7},
                      {"convergence-tolerance", 1e-05}};

/// Of profile default.
const Values ADAPTIVE = {{"sampling", 2},
                         {"least-samples", 5000},
                         {"levels", 3},
                         {"smallest-level", 1},
                         {"tile-tolerance", 2.25},
                         {"min-fill", 0.625},
                         {"noise-percentile", 0.55},
                         {"growth-percentile", 0.45},
                         {"max-growth", 1.75},
                         {"long-range", 1.625},
                         {"flatness", 0.011},
                         {"max-flatness", 0.0035},
                         {"flatness-noise", 0.002},
                         {"quiet-flatness", 0.6},
                         {"min-sigma", 3e-05},
                         {"local-reach", 3},
                         {"local-percentile", 0.375},
                         {"max-local", 3.5},
                         {"merge-tolerance", 2.75},
                         {"region-tolerance", 2.125},
                         {"accept-tolerance", 1.875},
                         {"min-points", 150},
                         {"min-evidence", 450.5},
                         {"join-coplanar", false},
                         {"join-tolerance", 1.75},
                         {"join-gap", 2.5},
                         {"join-seen", 0.125},
                         {"join-over-occluders", false},
                         {"fan-parts", 4},
                         {"fan-angle", 21.5},
                         {"fan-share", 0.007},
                         {"fan-border", 0.375},
                         {"fan-gap", 2.5},
                         {"fan-ring", 0.8},
                         {"bend-angle", 17.5},
                         {"support-reach", 3},
                         {"none-cost", 4.5},
                         {"label-change", 1.25},
                         {"step-sigmas", 6.5},
                         {"min-weight", 0.125},
                         {"passes", 4},
                         {"rounds", 1}};

/// All of a profile, after the common ones.
Values valuesOf(const std::string& profile)
{
  Values values = COMMON;
  const Values& own = profile == "paper" ? PAPER : ADAPTIVE;
  values.insert(values.end(), own.begin(), own.end());
  if (profile == "paper")
    values.emplace_back("energy", true);
  return values;
}

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

std::vector<std::string> optionsOf(const std::string& profile)
{
  std::vector<std::string> options = {"--profile", profile};
  for (const auto& value : valuesOf(profile)) {
    options.push_back("--" + value.first);
    if (value.first != "energy") // a switch
      options.push_back(textOf(value.second));
  }
  return options;
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
  std::vector<std::string> names = OTHER_OPTIONS;
  for (const char* profile : {"default", "paper"})
    for (const auto& value : valuesOf(profile))
      names.push_back(value.first);
  for (const std::string& option : names)
    EXPECT_NE(outcome.out.find("--" + option + " "), std::string::npos) << option;
  for (const char* word :
       {"Parameters of profile default", "Parameters of profile paper", "(default: 40)",
        "(default: auto)", "structured_light", "predicted-depth", "geometric",
        "Exit status"})
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
  for (const std::string profile : {"default", "paper"}) {
    const Json defaults = reportOf({"--profile", profile})["parameters"];
    const Json parameters = reportOf(optionsOf(profile))["parameters"];
    const Values values = valuesOf(profile);
    for (const auto& value : values) {
      const std::string key = keyOf(value.first);
      ASSERT_TRUE(parameters.contains(key)) << profile << ": " << value.first;
      EXPECT_EQ(parameters[key], value.second) << profile << ": " << value.first;
      EXPECT_NE(defaults[key], value.second)
          << profile << ": " << value.first << " is its default, which proves nothing";
    }
    EXPECT_EQ(parameters["profile"], profile);
    EXPECT_EQ(parameters.size(), values.size() + 1) << "profile and these";
  }
}

TEST_F(CommandLine, TheProfileIsDefaultUnlessNamed)
{
  EXPECT_EQ(reportOf({}), reportOf({"--profile", "default"}));
}

TEST_F(CommandLine, AnOptionOfTheOtherProfileIsRefused)
{
  const auto before = files();
  for (const bool paper : {false, true}) {
    const std::string profile = paper ? "paper" : "default";
    const std::string other = paper ? "default" : "paper";
    Values values = paper ? ADAPTIVE : PAPER;
    if (!paper)
      values.emplace_back("energy", true);
    for (const auto& value : values) {
      std::vector<std::string> options = {path("in.pcd"), path("out.pcd"), "--profile",
                                          profile, "--" + value.first};
      if (value.first != "energy")
        options.push_back(textOf(value.second));
      const Outcome outcome = segment(options);
      EXPECT_EQ(outcome.status, 2) << value.first;
      EXPECT_EQ(outcome.err, "pcl_mrf_plane_segmentation: --" + value.first +
                                 " has no effect in profile " + profile +
                                 "; add --profile " + other + "\n");
    }
    write("other.ini", values[0].first + "=" + textOf(values[0].second) + "\n");
    EXPECT_EQ(segment({path("in.pcd"), path("out.pcd"), "--profile", profile,
                       "--config", path("other.ini")})
                  .status,
              2)
        << "in a configuration file, too";
    std::filesystem::remove(path("other.ini"));
  }
  EXPECT_EQ(files(), before) << "a file was left";
}

TEST_F(CommandLine, AConfigurationFileIsTheSameAsOptions)
{
  for (const std::string profile : {"default", "paper"}) {
    std::string file = "# a comment\nprofile = " + profile +
                       "\nlabel-image = " + path(profile + ".png") + "\n";
    for (const auto& value : valuesOf(profile))
      file += value.first + " = " + textOf(value.second) + "\n";
    write("options.ini", file);
    const Json by_options = reportOf(optionsOf(profile));
    const Json by_file = reportOf({"--config", path("options.ini")});
    EXPECT_EQ(by_file, by_options) << profile;
    EXPECT_EQ(files().count(profile + ".png"), 1u) << "files can be named there, too";
  }
}

TEST_F(CommandLine, WinsOverTheConfigurationFile)
{
  write("paper.ini", "profile=paper\nbeta=0.9\ntau=0.2\n");
  const Json paper =
      reportOf({"--config", path("paper.ini"), "--beta", "0.1"})["parameters"];
  EXPECT_EQ(paper["beta"], 0.1);
  EXPECT_EQ(paper["tau"], 0.2);
  write("default.ini", "profile=paper\nmin-fill=0.9\npasses=5\n");
  const Json adaptive = reportOf({"--config", path("default.ini"), "--profile",
                                  "default", "--passes", "1"})["parameters"];
  EXPECT_EQ(adaptive["profile"], "default");
  EXPECT_EQ(adaptive["passes"], 1);
  EXPECT_EQ(adaptive["min_fill"], 0.9);
}

TEST_F(CommandLine, NoiseIsAPresetMetresOrCoefficients)
{
  const auto noiseOf = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"--profile", "paper"});
    return reportOf(options)["parameters"]["noise"];
  };
  for (const char* value :
       {"kinect", "structured_light", "time_of_flight", "lidar", "none"})
    EXPECT_EQ(noiseOf({"--noise", value}), Json(value));
  EXPECT_EQ(noiseOf({"--noise", "0.015"}), 0.015);
  EXPECT_EQ(noiseOf({"--noise=0.01,0,-1e-4"}), "0.01,0,-0.0001");
}

TEST_F(CommandLine, TakesNegativeNumbers)
{
  const Json report =
      reportOf({"--profile", "paper", "--convergence-tolerance", "-2.5"});
  EXPECT_EQ(report["parameters"]["convergence_tolerance"], -2.5);
}

TEST_F(CommandLine, NumbersDoNotDependOnTheLocale)
{
  const std::vector<std::vector<std::string>> choices = {
      {"--profile", "paper", "--beta", "0.25"}, {"--min-fill", "0.625"}};
  for (const auto& options : choices) {
    const Json plain = reportOf(options);
    for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8"}) {
      std::vector<std::string> arguments = {path("in.pcd"), "--models", path("m.json")};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const Outcome outcome = run(PCL_MRF_PLANES_SEGMENTATION_APP, arguments,
                                  {{"LC_ALL", locale}, {"LANG", locale}});
      ASSERT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(Json::parse(read("m.json")), plain) << locale;
    }
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
  const std::string paper = "--profile=paper";
  write("unknown.ini", "no-such-option=1\n");
  write("nonsense.ini", "just words\n");
  const std::vector<Case> cases = {
      {{}, "no input file"},
      {{in}, "nothing to write"},
      {{in, out, "third.pcd"}, "too many files"},
      {{in, out, "--no-such-option"}, "no-such-option"},
      {{in, out, "--tile-wid", "20"}, "tile-wid"},
      {{in, out, "-beta", "1"}, "-beta"},
      {{in, out, paper, "--beta"}, "beta"},
      {{in, out, paper, "--beta", "much"}, "'much'"},
      {{in, out, paper, "--beta", "1,5"}, "'1,5'"},
      {{in, out, paper, "--beta", "nan"}, "'nan'"},
      {{in, out, paper, "--beta", "1e999"}, "'1e999'"},
      {{in, out, paper, "--beta="}, "beta"},
      {{in, out, paper, "--beta", "-1"}, "--beta is -1; choose a value from 0"},
      {{in, out, paper, "--beta", "1", "--beta", "2"}, "beta"},
      {{in, out, paper, "--tile-width", "1"},
       "--tile-width is 1; choose a value from 2"},
      {{in, out, paper, "--tile-width", "10.5"}, "'10.5'"},
      {{in, out, paper, "--tile-width", "99999999999"}, "whole number"},
      {{in, out, paper, "--min-valid-share", "1.5"}, "from 0 to 1"},
      {{in, out, "--threads", "-1"}, "from 0 to 1024"},
      {{in, out, "--repeat", "0"}, "from 1 to"},
      {{in, out, paper, "--fit", "best"}, "algebraic, geometric"},
      {{in, out, "--depth", "y"}, "auto, z, range"},
      {{in, out, paper, "--smoothness", "strong"}, "potts, dissimilarity"},
      {{in, out, "--profile", "fastest"}, "paper"},
      {{in, out, "--format", "ply"}, "ascii, binary, binary_compressed"},
      {{in, out, paper, "--noise", "loud"}, "kinect"},
      {{in, out, paper, "--noise", "1,2"}, "a,b,c"},
      {{in, out, paper, "--noise", "1,2,3,"}, "a,b,c"},
      {{in, out, paper, "--noise", "-0.01"}, "--noise"},
      {{in, out, "--tile-width", "20"},
       "--tile-width has no effect in profile default; add --profile paper"},
      {{in, out, "--energy"}, "--energy has no effect in profile default"},
      {{in, out, paper, "--levels", "4"},
       "--levels has no effect in profile paper; add --profile default"},
      {{in, out, paper, "--noise", "auto"}, "--noise is auto"},
      {{in, out, "--levels", "9"}, "--levels is 9; choose a value from 2 to 8"},
      {{in, out, "--min-fill", "1.5"}, "--min-fill is 1.5; choose a value from 0 to 1"},
      {{in, out, "--passes", "1.5"}, "whole number"},
      {{in, out, "--none-cost", "high"}, "'high'"},
      {{in, out, "--join-coplanar", "perhaps"}, "true, false"},
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
