// SPDX-License-Identifier: BSD-3-Clause
// The evaluation against an independent scorer: the Python program in the environment
// variable PCL_MRF_PLANES_SCORER, which takes --truth, --pred, -T, --min-px and --json.
#include "cli_test.h"
#include "label_files.h"
#include "reference/label_images.h"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace pcl_mrf_planes::test {

namespace {

using Json = nlohmann::json;

constexpr const char* PYTHON = "/usr/bin/python3";
constexpr int FRAMES = 40;

/// Python writes NaN, for which JSON has no word.
Json parsePython(std::string text)
{
  for (std::size_t at = 0; (at = text.find("NaN", at)) != std::string::npos;)
    text.replace(at, 3, "null");
  return Json::parse(text, nullptr, false);
}

} // namespace

class EvaluationScorer : public CliTest {
protected:
  void SetUp() override
  {
    CliTest::SetUp();
    const char* scorer = std::getenv("PCL_MRF_PLANES_SCORER");
    if (scorer == nullptr)
      GTEST_SKIP() << "PCL_MRF_PLANES_SCORER names no scorer";
    scorer_ = scorer;
    if (run(PYTHON, {"-c", "import numpy, PIL"}).status != 0)
      GTEST_SKIP() << PYTHON << " lacks numpy or PIL";
  }

  std::string scorer_;
};

TEST_F(EvaluationScorer, AgreesOnRandomImages)
{
  const std::vector<std::pair<std::string, std::string>> settings = {
      {"0.8", "0"}, {"0.51", "0"}, {"0.95", "3"}, {"1", "10"}};
  for (std::size_t k = 0; k < settings.size(); ++k) {
    SCOPED_TRACE(settings[k].first);
    const std::string set = std::to_string(k) + '/';
    for (int frame = 0; frame < FRAMES; ++frame) {
      const auto pair =
          reference::randomPair(static_cast<std::uint64_t>(frame) + 1000 * k, 40);
      const std::string name = std::to_string(frame);
      writeLabels(path(set + "truth/" + name + ".gt.png"), pair.truth);
      if (frame % 10 != 3) // one in ten has no result
        writeLabels(path(set + "result/" + name + ".png"), pair.labels);
    }
    const Outcome theirs =
        run(PYTHON, {"-W", "ignore", scorer_, "--truth", path(set + "truth"), "--pred",
                     path(set + "result"), "-T", settings[k].first, "--min-px",
                     settings[k].second, "--json"});
    ASSERT_EQ(theirs.status, 0) << theirs.err;
    const Outcome ours =
        run(PCL_MRF_PLANES_EVALUATION_APP,
            {"--truth", path(set + "truth"), "--labels", path(set + "result"),
             "--tolerance", settings[k].first, "--min-points", settings[k].second,
             "--json", path("report.json")});
    ASSERT_EQ(ours.status, 0) << ours.err;
    const Json expected = parsePython(theirs.out);
    const Json all = Json::parse(read("report.json"))["all"];
    EXPECT_EQ(all["frames"], expected["frames"]);
    for (const char* name : {"ratio", "truth", "correct", "over", "under", "missed",
                             "noise", "pq", "sc", "ri", "voi", "recall", "clutter"}) {
      const char* theirs_name = std::string(name) == "truth" ? "gt" : name;
      ASSERT_TRUE(expected.contains(theirs_name)) << name << theirs.out;
      ASSERT_EQ(all[name].is_null(), expected[theirs_name].is_null()) << name;
      if (!all[name].is_null()) {
        EXPECT_NEAR(all[name].get<double>(), expected[theirs_name].get<double>(), 1e-12)
            << name;
      }
    }
  }
}

} // namespace pcl_mrf_planes::test
