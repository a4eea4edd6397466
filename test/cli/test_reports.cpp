// SPDX-License-Identifier: BSD-3-Clause
// What the app prints and the files beside the cloud: JSON, pictures, times.
#include "cli_test.h"
#include "two_planes.h"

#include <nlohmann/json.hpp>
#include <vtkImageData.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <cmath>

namespace pcl_mrf_planes::test {

namespace {

using Json = nlohmann::json;

/// A PNG with rows counted from the top, as in the cloud.
class Png {
public:
  explicit Png(const std::string& path)
  : reader_(vtkSmartPointer<vtkPNGReader>::New())
  {
    reader_->SetFileName(path.c_str());
    reader_->Update();
  }
  int width() const { return reader_->GetOutput()->GetDimensions()[0]; }
  int height() const { return reader_->GetOutput()->GetDimensions()[1]; }
  int channels() const { return reader_->GetOutput()->GetNumberOfScalarComponents(); }
  int bytes() const { return reader_->GetOutput()->GetScalarSize(); }
  int at(int x, int y, int channel = 0) const
  {
    return static_cast<int>(reader_->GetOutput()->GetScalarComponentAsDouble(
        x, height() - 1 - y, 0, channel));
  }

private:
  vtkSmartPointer<vtkPNGReader> reader_;
};

std::size_t indexOf(int x, int y)
{
  return static_cast<std::size_t>(y * TwoPlanes::WIDTH + x);
}

} // namespace

class Reports : public CliTest {
protected:
  void SetUp() override
  {
    CliTest::SetUp();
    scene_.write(path("in.pcd"), "binary_compressed");
  }

  Json models(std::vector<std::string> options) const
  {
    options.insert(options.begin(), {path("in.pcd"), "--models", path("m.json")});
    const Outcome outcome = segment(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(read("m.json"));
  }

  TwoPlanes scene_;
};

TEST_F(Reports, JsonDescribesThePlanesInTheFrameOfTheCloud)
{
  const Json report = models({"--profile", "paper"});
  ASSERT_EQ(report["planes"].size(), 2u);
  const Eigen::Vector3f toward_camera(0.0f, 0.0f, -1.0f);
  const Eigen::Vector3f up(0.0f, -1.0f, 0.0f);
  const Eigen::Vector3f normals[] = {scene_.orientation * toward_camera,
                                     scene_.orientation * up};
  const float heights[] = {2.0f, 2.0f * 20.0f / 150.0f}; // camera over wall, floor
  std::size_t points = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Json& plane = report["planes"][k];
    EXPECT_EQ(plane["label"], k + 1);
    const auto abcd = plane["coefficients"].get<std::vector<float>>();
    ASSERT_EQ(abcd.size(), 4u);
    const Eigen::Vector3f normal(abcd[0], abcd[1], abcd[2]);
    EXPECT_LT((normal - normals[k]).norm(), 1e-3f) << "normals point to the sensor";
    EXPECT_NEAR(normal.dot(scene_.origin.head<3>()) + abcd[3], heights[k], 5e-3f);
    const auto centroid = plane["centroid"].get<std::vector<float>>();
    ASSERT_EQ(centroid.size(), 3u);
    EXPECT_NEAR(normal.dot(Eigen::Vector3f(centroid.data())) + abcd[3], 0.0f, 0.02f);
    EXPECT_GT(plane["area_m2"], 1.0);
    EXPECT_LT(plane["rms_m"], 0.05);
    points += plane["points"].get<std::size_t>();
  }
  const Json& counts = report["counts"];
  EXPECT_EQ(counts["points"], TwoPlanes::POINTS);
  EXPECT_EQ(counts["width"], TwoPlanes::WIDTH);
  EXPECT_EQ(counts["height"], TwoPlanes::HEIGHT);
  EXPECT_EQ(counts["planes"], 2);
  EXPECT_EQ(counts["tiles_tried"], 12);
  EXPECT_NEAR(counts["labelled_share"].get<double>() *
                  counts["valid_points"].get<double>(),
              static_cast<double>(points), 0.5);
  EXPECT_FALSE(report["version"].get<std::string>().empty());
  EXPECT_EQ(report["parameters"]["profile"], "paper");
  EXPECT_EQ(report["parameters"]["tile_width"], 40);
  EXPECT_EQ(report["parameters"]["beta"], 0.4);
  EXPECT_EQ(report["parameters"]["noise"], "kinect");
  EXPECT_FALSE(report.contains("timing")) << "times only when asked for";
  EXPECT_FALSE(report.contains("energy")) << "energy only when asked for";
}

TEST_F(Reports, JsonNamesTheParametersOfTheDefaultProfile)
{
  const Json report = models({});
  EXPECT_EQ(report["planes"].size(), 2u);
  const Json& parameters = report["parameters"];
  EXPECT_EQ(parameters["profile"], "default");
  EXPECT_EQ(parameters["levels"], 4);
  EXPECT_EQ(parameters["noise"], "auto");
  EXPECT_EQ(parameters["join_coplanar"], true);
  EXPECT_FALSE(parameters.contains("tile_width")) << "it has no effect";
  EXPECT_FALSE(report.contains("energy"));
}

TEST_F(Reports, JsonHoldsEnergiesWhenAskedFor)
{
  const Json report = models({"--profile", "paper", "--energy", "--iterations", "3"});
  ASSERT_EQ(report["energy"].size(), 4u) << "before and after each iteration";
  for (const Json& step : report["energy"])
    EXPECT_NEAR(step["data"].get<double>() + step["smoothness"].get<double>(),
                step["total"].get<double>(), 1e-9);
}

TEST_F(Reports, TimesAreMediansOfTheRuns)
{
  const Outcome outcome = segment(
      {path("in.pcd"), "--models", path("m.json"), "--repeat", "3", "--timing"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json timing = Json::parse(read("m.json"))["timing"];
  EXPECT_EQ(timing["runs"], 3);
  EXPECT_GT(timing["total_ms"], 0.0);
  for (const char* stage :
       {"points", "tiles", "merging", "field", "propagation", "regions"}) {
    ASSERT_TRUE(timing["stages"].contains(stage)) << stage;
    EXPECT_NE(outcome.out.find(stage), std::string::npos) << "printed as well";
    EXPECT_LE(timing["spread"]["stages"][stage]["min"], timing["stages"][stage]);
    EXPECT_GE(timing["spread"]["stages"][stage]["max"], timing["stages"][stage]);
  }
  EXPECT_LE(timing["spread"]["total_ms"]["min"], timing["total_ms"]);
  EXPECT_GE(timing["spread"]["total_ms"]["max"], timing["total_ms"]);
}

TEST_F(Reports, TimingNeedsNoOutputFile)
{
  const Outcome outcome = segment({path("in.pcd"), "--timing"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("total"), std::string::npos);
}

TEST_F(Reports, LabelImageHasSixteenBitsAndTheCloudsLabels)
{
  ASSERT_EQ(segment({path("in.pcd"), "--label-image", path("labels.png")}).status, 0);
  const Png image(path("labels.png"));
  ASSERT_EQ(image.width(), TwoPlanes::WIDTH);
  ASSERT_EQ(image.height(), TwoPlanes::HEIGHT);
  EXPECT_EQ(image.channels(), 1);
  EXPECT_EQ(image.bytes(), 2);
  EXPECT_EQ(image.at(81, 10), 1) << "the wall is above";
  EXPECT_EQ(image.at(81, 110), 2) << "the floor is below";
  EXPECT_EQ(image.at(0, 0), 0) << "invalid points have no label";
  EXPECT_EQ(image.at(5, 5), 0) << "invalid points have no label";
}

TEST_F(Reports, OverlayShowsColourDepthAndLabelsUnshifted)
{
  ASSERT_EQ(segment({path("in.pcd"), "--overlay", path("o.png")}).status, 0);
  const Png image(path("o.png"));
  const int gap = (image.width() - 3 * TwoPlanes::WIDTH) / 2;
  ASSERT_GE(gap, 0);
  ASSERT_LE(gap, 16);
  ASSERT_EQ(image.height(), TwoPlanes::HEIGHT);
  ASSERT_EQ(image.channels(), 3);
  const int depth = TwoPlanes::WIDTH + gap;
  const int labels = 2 * depth;
  for (int y = 0; y < TwoPlanes::HEIGHT; y += 7)
    for (int x = 0; x < TwoPlanes::WIDTH; x += 3) {
      const std::uint32_t colour = TwoPlanes::colour(indexOf(x, y));
      EXPECT_EQ(image.at(x, y, 0), static_cast<int>((colour >> 16) & 255));
      EXPECT_EQ(image.at(x, y, 1), static_cast<int>((colour >> 8) & 255));
      EXPECT_EQ(image.at(x, y, 2), static_cast<int>(colour & 255));
      const bool black = image.at(depth + x, y, 0) == 0 &&
                         image.at(depth + x, y, 1) == 0 &&
                         image.at(depth + x, y, 2) == 0;
      EXPECT_EQ(black, !TwoPlanes::valid(indexOf(x, y)))
          << "the panel of depth shows invalid points black";
    }
  const auto differ = [&](int ax, int ay, int bx, int by) {
    int sum = 0;
    for (int c = 0; c < 3; ++c)
      sum += std::abs(image.at(ax, ay, c) - image.at(bx, by, c));
    return sum;
  };
  EXPECT_GT(differ(labels + 81, 70, labels + 81, 90), 60) << "wall and floor";
  EXPECT_LT(differ(labels + 81, 70, labels + 81, 60), 60) << "wall and wall";
  EXPECT_GT(differ(depth + 81, 70, depth + 81, 119), 60) << "far and near";
}

TEST_F(Reports, OverlayWithoutColourShadesTheSurface)
{
  scene_.cloud.fields[3].name = "other";
  scene_.write(path("in.pcd"), "binary");
  ASSERT_EQ(segment({path("in.pcd"), "--overlay", path("o.png")}).status, 0);
  const Png image(path("o.png"));
  EXPECT_EQ(image.at(81, 40, 0), image.at(81, 40, 2)) << "gray";
  EXPECT_GT(image.at(81, 40), image.at(81, 90) + 20)
      << "the wall, seen from the front, is brighter than the floor";
  EXPECT_EQ(image.at(5, 5), 0) << "invalid points are black";
}

TEST_F(Reports, TableHasALineForEachPlaneAndASummary)
{
  const Outcome outcome = segment({path("in.pcd"), path("out.pcd")});
  std::istringstream lines(outcome.out);
  std::vector<std::string> all;
  for (std::string line; std::getline(lines, line);)
    all.push_back(line);
  ASSERT_EQ(all.size(), 4u) << outcome.out;
  EXPECT_NE(all[0].find("area m2"), std::string::npos);
  EXPECT_NE(all[3].find("2 planes"), std::string::npos);
  EXPECT_EQ(segment({path("in.pcd"), path("out.pcd"), "--quiet"}).out, "");
}

TEST_F(Reports, NoPlaneIsNoError)
{
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i) // a rough surface
    setField(scene_.cloud, i, "x",
             getField<float>(scene_.cloud, i, "x") +
                 0.01f * static_cast<float>(i * 7919 % 13));
  scene_.write(path("in.pcd"), "binary");
  const std::vector<std::vector<std::string>> choices = {
      {"--profile", "paper", "--noise", "1e-4"},
      {"--max-growth", "1", "--min-points", "1000000"}};
  for (const auto& choice : choices) {
    std::vector<std::string> options = {path("in.pcd"),  "--models",    path("m.json"),
                                        "--label-image", path("l.png"), "--overlay",
                                        path("o.png")};
    options.insert(options.end(), choice.begin(), choice.end());
    const Outcome outcome = segment(options);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("no plane"), std::string::npos);
    const bool paper = choice[0] == "--profile";
    EXPECT_NE(outcome.out.find(paper ? "--noise" : "--min-"), std::string::npos)
        << "says what to try: " << outcome.out;
    if (!paper) {
      EXPECT_EQ(outcome.out.find("--noise"), std::string::npos)
          << "has no effect in this profile: " << outcome.out;
    }
    const Json report = Json::parse(read("m.json"));
    EXPECT_TRUE(report["planes"].is_array());
    EXPECT_EQ(report["planes"].size(), 0u);
    const Png image(path("l.png"));
    int labelled = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        labelled += image.at(x, y) != 0 ? 1 : 0;
    EXPECT_EQ(labelled, 0);
  }
}

} // namespace pcl_mrf_planes::test
