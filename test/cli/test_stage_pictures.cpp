// SPDX-License-Identifier: BSD-3-Clause
// Pictures of the stages and of the two profiles.
#include "batch_test.h"

#include <gmock/gmock.h>

#include <cstdlib>

namespace pcl_mrf_planes::test {
namespace {

using ::testing::HasSubstr;

/// Width and height as the head of a PNG states them.
std::pair<int, int> sizeOfPng(const std::string& bytes)
{
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = at; k < at + 4; ++k)
      value = 256 * value + static_cast<unsigned char>(bytes.at(k));
    return value;
  };
  return bytes.size() < 24 ? std::make_pair(0, 0)
                           : std::make_pair(number(16), number(20));
}

class StagePictures : public BatchTest {
protected:
  void SetUp() override
  {
    BatchTest::SetUp();
    scene_.write(path("in.pcd"), "binary");
  }

  std::vector<std::vector<std::string>> table(const std::string& name) const
  {
    std::vector<std::vector<std::string>> cells;
    for (const std::string& row : rows(name)) {
      cells.emplace_back();
      std::istringstream stream(row + ',');
      for (std::string cell; std::getline(stream, cell, ',');)
        cells.back().push_back(cell);
    }
    return cells;
  }
};

TEST_F(StagePictures, EveryStageHasAPictureAndALine)
{
  for (const std::string profile : {"default", "paper"}) {
    const Outcome outcome =
        segment({path("in.pcd"), "--stages", path("st/" + profile), "--profile",
                 profile, "--label-image", path("labels.png")});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto stages = table("st/" + profile + "/stages.csv");
    ASSERT_GE(stages.size(), 4U);
    EXPECT_EQ(stages.back()[1], "final");
    EXPECT_EQ(stages.back()[3], "2") << "wall and floor";
    for (const auto& cells : stages) {
      EXPECT_EQ(sizeOfPng(read("st/" + profile + '/' + cells[0])),
                std::make_pair(TwoPlanes::WIDTH, TwoPlanes::HEIGHT))
          << cells[0];
      ASSERT_EQ(cells.size(), 8U);
      EXPECT_EQ(cells[7].empty(), cells[1] != "iteration");
    }
    EXPECT_EQ(sizeOfPng(read("st/" + profile + "/00_tiles.png")).first,
              TwoPlanes::WIDTH);
    EXPECT_FALSE(table("st/" + profile + "/tiles.csv").empty());
  }
}

TEST_F(StagePictures, TheEnergiesOfTheTableAddUp)
{
  ASSERT_EQ(segment({path("in.pcd"), "--stages", path("st"), "--profile=paper",
                     "--iterations", "3"})
                .status,
            0);
  int iterations = 0;
  for (const auto& cells : table("st/stages.csv")) {
    if (cells[1] != "iteration")
      continue;
    EXPECT_EQ(cells[2], std::to_string(iterations++));
    const double total = std::strtod(cells[7].c_str(), nullptr);
    EXPECT_NEAR(total,
                std::strtod(cells[5].c_str(), nullptr) +
                    std::strtod(cells[6].c_str(), nullptr),
                1e-6 * total);
  }
  EXPECT_EQ(iterations, 4) << "0 to 3";
}

TEST_F(StagePictures, AFigureHasARowForEachOfTwoProfiles)
{
  ASSERT_EQ(segment({path("in.pcd"), "--figure", path("fig.png"), "--overlay",
                     path("default.png")})
                .status,
            0);
  const auto row = sizeOfPng(read("default.png"));
  const auto figure = sizeOfPng(read("fig.png"));
  EXPECT_EQ(figure.first, row.first);
  EXPECT_EQ(figure.second, 2 * row.second + 4) << "a gap of four points";
}

TEST_F(StagePictures, ABatchWritesAFigureForEveryFrame)
{
  writeScene("in/a.pcd");
  writeDepth("in/sub/b.depth.png");
  write("in/sub/camera.json", R"({"fx": 150, "fy": 150, "cx": 80, "cy": 60})");
  const Outcome outcome =
      run(PCL_MRF_PLANES_SOURCE "/scripts/figures", {path("in"), path("out")},
          {{"PCL_MRF_PLANES_APP", PCL_MRF_PLANES_SEGMENTATION_APP}});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(sizeOfPng(read("out/a.figure.png")).first, 3 * TwoPlanes::WIDTH);
  EXPECT_GT(sizeOfPng(read("out/sub/b.figure.png")).first, 3 * 160);
}

TEST_F(StagePictures, ScriptAndOptionsSayWhatIsWrong)
{
  const std::string script = PCL_MRF_PLANES_SOURCE "/scripts/figures";
  EXPECT_EQ(run(script, {}).status, 2);
  const Outcome missing = run(script, {path("missing")});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("missing"));
  write("file", "no folder");
  const Outcome blocked =
      segment({path("in.pcd"), "--stages", path("file/below"), "--quiet"});
  EXPECT_EQ(blocked.status, 1);
  EXPECT_THAT(blocked.err, HasSubstr("cannot create the folder"));
  const Outcome many =
      segment({path("in.pcd"), "--output-folder", path("out"), "--stages", path("st")});
  EXPECT_EQ(many.status, 2);
  EXPECT_THAT(many.err, HasSubstr("--stages is for a single frame"));
  const Outcome same =
      segment({path("in.pcd"), "--figure", path("x.png"), "--overlay", path("x.png")});
  EXPECT_EQ(same.status, 2);
}

} // namespace
} // namespace pcl_mrf_planes::test
