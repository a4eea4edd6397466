// SPDX-License-Identifier: BSD-3-Clause
// Parameter files: what is written is read back, and what is wrong is named.
#include "cli_test.h"
#include "two_planes.h"

#include <nlohmann/json.hpp>

namespace pcl_mrf_planes::test {
namespace {

using Json = nlohmann::json;

class ParameterFileTest : public CliTest {
protected:
  Outcome save(const std::string& name, std::vector<std::string> options = {}) const
  {
    options.insert(options.end(), {"--save-parameters", path(name)});
    return segment(options);
  }

  /// The parameters that a run reports.
  Json used(std::vector<std::string> options) const
  {
    TwoPlanes().write(path("in.pcd"), "binary");
    options.insert(options.begin(), {path("in.pcd"), "--models", path("used.json")});
    const Outcome outcome = segment(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.status == 0 ? Json::parse(read("used.json")).at("parameters")
                               : Json();
  }
};

TEST_F(ParameterFileTest, EveryProfileComesBackAsItWas)
{
  for (const std::string profile : {"default", "fast", "paper"}) {
    ASSERT_EQ(save("a.txt", {"--profile", profile}).status, 0);
    const Outcome outcome = save("b.txt", {"--parameters", path("a.txt")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(read("a.txt"), read("b.txt"));
    EXPECT_EQ(used({"--parameters", path("a.txt")}), used({"--profile", profile}));
  }
}

TEST_F(ParameterFileTest, ChangedValuesComeBackBitForBit)
{
  const std::vector<std::vector<std::string>> cases = {
      {"--merge-tolerance", "3.3000000000000003", "--join-coplanar", "false", "--noise",
       "0.001,0.0002,0.0014", "--min-points", "77", "--depth", "range"},
      {"--profile", "paper", "--energy", "--tau", "0.1", "--noise", "lidar",
       "--smoothness", "potts", "--tile-width", "17", "--threads", "2"}};
  for (const auto& options : cases) {
    ASSERT_EQ(save("a.txt", options).status, 0);
    EXPECT_EQ(used({"--parameters", path("a.txt")}), used(options));
  }
}

TEST_F(ParameterFileTest, TheCommandLineWins)
{
  write("p.txt", "profile = paper # section V\n\n  beta=0.5\ntau = 0.25\n");
  const Json values = used({"--parameters", path("p.txt"), "--beta", "0.75"});
  EXPECT_EQ(values.at("beta"), 0.75);
  EXPECT_EQ(values.at("tau"), 0.25);
  EXPECT_EQ(values.at("lambda"), 0.2) << "the profile's";
}

TEST_F(ParameterFileTest, TheProfileOfTheCommandLineWinsToo)
{
  write("p.txt", "profile = default\nmin-evidence = 321\n");
  const Json values = used({"--parameters", path("p.txt"), "--profile", "fast"});
  EXPECT_EQ(values.at("sampling"), 3);
  EXPECT_EQ(values.at("min_evidence"), 321);
}

TEST_F(ParameterFileTest, MistakesAreNamedWithTheirLine)
{
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"tau = 1\n", {"line 1", "tau has no effect in profile default", "paper"}},
      {"\n# x\nlevls = 3\n", {"line 3", "no parameter 'levls'", "--help"}},
      {"levels 3\n", {"line 1", "NAME = VALUE"}},
      {"= 3\n", {"line 1", "NAME = VALUE"}},
      {"levels =\n", {"line 1", "levels is ''"}},
      {"levels = 99\n", {"line 1", "levels is 99", "from 2 to 8"}},
      {"flatness = nan\n", {"line 1", "flatness is 'nan'"}},
      {"levels = 3\nlevels = 3\n", {"line 2", "line 1 already"}},
      {"profile = best\n", {"line 1", "'best'", "default, fast, paper"}},
      {"profile = paper\nenergy = 1\n", {"line 2", "true, false"}},
      {"fan-parts = 1\n", {"fan_parts is 1"}},
      {std::string("\0\xff\x01 = \n", 7), {"line 1", "no parameter"}}};
  for (const auto& [text, words] : cases) {
    write("bad.txt", text);
    const Outcome outcome = save("out.txt", {"--parameters", path("bad.txt")});
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_NE(outcome.err.find("bad.txt"), std::string::npos) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos)
          << word << ": " << outcome.err;
    EXPECT_EQ(files().count("out.txt"), 0U);
  }
}

TEST_F(ParameterFileTest, FilesThatCannotBeReadOrWrittenAreNamed)
{
  EXPECT_EQ(save("out.txt", {"--parameters", path("missing.txt")}).status, 2);
  EXPECT_EQ(save("out.txt", {"--parameters", path(".")}).status, 2);
  const Outcome outcome = save("no/such/folder.txt");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("no/such"), std::string::npos) << outcome.err;
}

} // namespace
} // namespace pcl_mrf_planes::test
