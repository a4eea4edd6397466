// SPDX-License-Identifier: BSD-3-Clause
// What the apps write and read is the same where decimals have a comma.
#include "cli_test.h"

namespace pcl_mrf_planes::test {

class CommaLocale : public CliTest {
protected:
  using Environment = std::vector<std::pair<std::string, std::string>>;

  /// Makes the locale, so that it need not be one of the system's.
  void SetUp() override
  {
    CliTest::SetUp();
    const Outcome made = run("/usr/bin/localedef", {"-i", "de_DE", "-f", "UTF-8",
                                                    locales() + "/de_DE.UTF-8"});
    if (made.status != 0)
      GTEST_SKIP() << "no sources of locales here (Debian: package locales)";
    comma_ = {{"LOCPATH", locales()}, {"LC_ALL", "de_DE.UTF-8"}};
    ASSERT_EQ(run("/usr/bin/printf", {"%.2f", "1,5"}, comma_).out, "1,50");
  }

  std::string locales() const
  {
    std::filesystem::create_directories(path("locales"));
    return path("locales");
  }

  void expectRun(const std::string& app, const std::vector<std::string>& arguments,
                 const Environment& environment) const
  {
    const Outcome outcome = run(app, arguments, environment);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }

  /// Every kind of file that has numbers in it; a scene first, then what is found in it.
  std::vector<std::string> writeAll(const Environment& environment) const
  {
    expectRun(PCL_MRF_PLANES_SCENE_APP,
              {path("in.pcd"), "--format", "ascii", "--noise", "0.5", "--width", "160",
               "--height", "120", "--planes", path("truth.json"), "--truth",
               path("truth.png")},
              environment);
    expectRun(PCL_MRF_PLANES_SEGMENTATION_APP,
              {path("in.pcd"), path("out.pcd"), "--format", "ascii", "--models",
               path("out.json"), "--ply", path("out.ply"), "--polygons",
               path("polygons.ply"), "--outlines", "--creases", "--confidence",
               "--label-image", path("out.png"), "--min-fill", "0.625",
               "--save-parameters", path("parameters.json")},
              environment);
    expectRun(PCL_MRF_PLANES_EVALUATION_APP,
              {path("truth.png"), path("out.png"), "--tolerance", "0.75", "--csv",
               path("scores.csv"), "--json", path("scores.json")},
              environment);
    // What was written is read again.
    expectRun(PCL_MRF_PLANES_SEGMENTATION_APP,
              {path("in.pcd"), path("again.pcd"), "--parameters",
               path("parameters.json"), "--models", path("again.json")},
              environment);
    std::vector<std::string> contents;
    for (const char* name : {"in.pcd", "truth.json", "truth.png", "out.pcd", "out.json",
                             "out.ply", "polygons.ply", "out.png", "parameters.json",
                             "scores.csv", "scores.json", "again.pcd", "again.json"})
      contents.push_back(read(name));
    return contents;
  }

  Environment comma_;
};

TEST_F(CommaLocale, ChangesNoFile)
{
  const std::vector<std::string> plain = writeAll({{"LC_ALL", "C"}});
  const std::vector<std::string> comma = writeAll(comma_);
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_FALSE(plain[k].empty()) << "file " << k;
    EXPECT_TRUE(comma[k] == plain[k]) << "file " << k;
  }
}

} // namespace pcl_mrf_planes::test
