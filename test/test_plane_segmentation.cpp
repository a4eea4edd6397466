// SPDX-License-Identifier: BSD-3-Clause
//
// The whole pipeline against the plain reference pipeline and against known scenes.
#include "reference/inputs.h"
#include "reference/paper_pipeline.h"

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

namespace pcl_mrf_planes {
namespace {

/// The label plane of every point; -1 where the point has no label.
std::vector<int> labelPlanes(const PlaneSegmentation& result)
{
  std::vector<int> planes;
  for (const std::uint16_t label : result.labels)
    planes.push_back(label == 0 ? -1 : result.regions[label - 1U].label);
  return planes;
}

/// Points whose label plane is another one than in the reference.
std::size_t countDifferent(const OrganizedPoints& points,
                           const PlaneSegmentation& result,
                           const reference::PaperResult& expected)
{
  const std::vector<int> found = labelPlanes(result);
  std::size_t different = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int wanted = points.valid[i] == 0 || expected.labels.empty()
                           ? -1
                           : static_cast<int>(expected.labels[i]);
    different += found[i] != wanted ? 1U : 0U;
  }
  return different;
}

void expectSamePlanes(const PlaneSegmentation& result,
                      const reference::PaperResult& expected)
{
  EXPECT_EQ(result.report.tiles_kept, expected.kept_tiles);
  ASSERT_EQ(result.clusters.planes.size(), expected.planes.size());
  for (std::size_t l = 0; l < expected.planes.size(); ++l) {
    const Plane& plane = result.clusters.planes[l].plane;
    EXPECT_LT((plane.normal - expected.planes[l].plane.head<3>()).norm(), 1e-5)
        << "label plane " << l;
    EXPECT_NEAR(plane.d, expected.planes[l].plane[3], 1e-5) << "label plane " << l;
    EXPECT_EQ(result.clusters.planes[l].points, expected.planes[l].points);
  }
}

struct PaperCase {
  const char* scene;
  std::uint64_t seed;
  int width, height;
};

void PrintTo(const PaperCase& c, std::ostream* out)
{
  *out << c.scene << " " << c.seed << " " << c.width << "x" << c.height;
}

class PaperTest : public testing::TestWithParam<PaperCase> {};

INSTANTIATE_TEST_SUITE_P(
    Scenes, PaperTest,
    testing::Values(PaperCase{"room", 1, 640, 480}, PaperCase{"room", 2, 320, 240},
                    PaperCase{"room", 3, 323, 243}, PaperCase{"room", 4, 163, 117},
                    PaperCase{"corner", 1, 320, 240}, PaperCase{"stairs", 1, 320, 240},
                    PaperCase{"sphere_on_plane", 1, 240, 180},
                    PaperCase{"box_on_table", 1, 320, 240}));

TEST_P(PaperTest, AgreesWithTheReferenceLabelForLabel)
{
  const PaperCase c = GetParam();
  const OrganizedPoints points = reference::toPoints(reference::takePicture(
      c.scene, c.width, c.height, c.seed, scenes::SensorNoise::kinect()));
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  // The same share of the picture as 40 of 640 columns.
  parameters.tile_width = parameters.tile_height = std::max(8, c.width / 16);
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  const auto expected =
      reference::segmentAsPaper<reference::WholeUnitEnergy>(points, parameters);
  ASSERT_GE(expected.planes.size(), 1U) << "too simple to prove anything";
  expectSamePlanes(result, expected);
  EXPECT_EQ(countDifferent(points, result, expected), 0U)
      << "profile PAPER is not the paper";

  const auto unrounded =
      reference::segmentAsPaper<reference::PaperEnergy>(points, parameters);
  EXPECT_LE(countDifferent(points, result, unrounded), points.size() / 200)
      << "16 bits change more than half a percent of the labels of the exact energy";
}

/// Energies of a scene by iteration, those of the initial labels first.
std::vector<FieldEnergy> energiesOf(const OrganizedPoints& points,
                                    Parameters parameters, int tile_size)
{
  parameters.tile_width = parameters.tile_height = tile_size;
  parameters.compute_energy = true;
  return segmentPlanes(points, parameters).report.energy;
}

TEST(PaperEnergyTest, FiveIterationsLowerTheEnergyOfNoisyRooms)
{
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const OrganizedPoints points = reference::toPoints(
        reference::takePicture("room", 320, 240, seed, scenes::SensorNoise::kinect()));
    const auto energy = energiesOf(points, Parameters::fromProfile(Profile::PAPER), 20);
    ASSERT_EQ(energy.size(), 6U) << "initial labels and five iterations";
    EXPECT_LT(energy.back().total(), 0.9 * energy.front().total())
        << "belief propagation must smooth away noise, room " << seed;
    EXPECT_LT(energy.back().smoothness, energy.front().smoothness) << "room " << seed;
    EXPECT_GE(energy.back().data, energy.front().data)
        << "the initial labels have the least data cost, room " << seed;
  }
}

// Propagation is not a descent: labels read off while the first messages still travel
// can cost more than the initial ones, most on clean scenes, where those are good. Once
// the messages have crossed the picture they cost less. That is no theorem either:
// small pictures of the stairs, whose planes cross everywhere, can end above.
TEST(PaperEnergyTest, ManyIterationsEndBelowTheInitialLabels)
{
  for (const char* scene :
       {"room", "corner", "step", "ramp", "box_on_table", "cylinder_room"})
    for (const Smoothness smoothness :
         {Smoothness::POTTS, Smoothness::DISSIMILARITY, Smoothness::HYBRID,
          Smoothness::PREDICTED_DEPTH})
      for (const auto& noise :
           {scenes::SensorNoise::none(), scenes::SensorNoise::kinect()}) {
        const OrganizedPoints points =
            reference::toPoints(reference::takePicture(scene, 120, 90, 5, noise));
        Parameters parameters = Parameters::fromProfile(Profile::PAPER);
        parameters.smoothness = smoothness;
        parameters.iterations = 60;
        const auto energy = energiesOf(points, parameters, 10);
        ASSERT_EQ(energy.size(), 61U) << scene;
        EXPECT_LE(energy.back().total(), energy.front().total() * (1.0 + 1e-12))
            << scene << ", smoothness " << static_cast<int>(smoothness)
            << ": worse than the initial labels after 60 iterations";
      }
}

TEST(PaperEnergyTest, ManySmallRoomsEndBelowTheirInitialLabels)
{
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const OrganizedPoints points = reference::toPoints(
        reference::takePicture("room", 80, 60, seed, scenes::SensorNoise::kinect()));
    Parameters parameters = Parameters::fromProfile(Profile::PAPER);
    parameters.lambda = seed % 2 == 0 ? 0.2 : 20.0;
    parameters.iterations = 60;
    const auto energy = energiesOf(points, parameters, 6 + static_cast<int>(seed % 5));
    if (!energy.empty()) {
      EXPECT_LE(energy.back().total(), energy.front().total() * (1.0 + 1e-12))
          << "room " << seed;
    }
  }
}

TEST(PaperEnergyTest, AskingForTheEnergyChangesNothing)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 160, 120, 5, scenes::SensorNoise::kinect()));
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.tile_width = parameters.tile_height = 10;
  const PlaneSegmentation without = segmentPlanes(points, parameters);
  EXPECT_TRUE(without.report.energy.empty()) << "not asked for";
  parameters.compute_energy = true;
  EXPECT_EQ(segmentPlanes(points, parameters).labels, without.labels);
}

TEST(PaperEnergyTest, ConvergenceStopsEarlyWithTheLabelsOfAllIterations)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("corner", 80, 60, 1, scenes::SensorNoise::none()));
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.tile_width = parameters.tile_height = 10;
  parameters.iterations = 3000;
  const PlaneSegmentation all = segmentPlanes(points, parameters);
  EXPECT_EQ(all.report.iterations, 3000);
  parameters.convergence_tolerance = 0.0;
  const PlaneSegmentation stopped = segmentPlanes(points, parameters);
  EXPECT_LT(stopped.report.iterations, 3000) << "did not settle";
  EXPECT_EQ(stopped.labels, all.labels) << "stopped before the messages were settled";
}

/// Share of the points with a true plane whose label is mostly of that plane.
double shareRight(const scenes::SceneFrame& frame, const PlaneSegmentation& result)
{
  std::map<int, std::map<int, std::size_t>> overlap;
  std::size_t points = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.labels[i] != 0) {
      ++points;
      if (result.labels[i] != 0)
        ++overlap[result.labels[i]][frame.labels[i]];
    }
  std::size_t right = 0;
  for (const auto& label : overlap) {
    std::size_t most = 0;
    for (const auto& truth : label.second)
      most = std::max(most, truth.second);
    right += most;
  }
  return static_cast<double>(right) / static_cast<double>(points);
}

TEST(SceneTest, SimpleScenesAreSegmentedRightly)
{
  struct Expectation {
    const char* scene;
    std::size_t planes;
    double share;
  };
  for (const Expectation& e :
       {Expectation{"corner", 3, 0.99}, Expectation{"single_plane", 1, 1.0}}) {
    const auto frame =
        reference::takePicture(e.scene, 320, 240, 1, scenes::SensorNoise::none());
    Parameters parameters = Parameters::fromProfile(Profile::PAPER);
    parameters.tile_width = parameters.tile_height = 20;
    const PlaneSegmentation result =
        segmentPlanes(reference::toPoints(frame), parameters);
    EXPECT_GE(shareRight(frame, result), e.share) << e.scene;
    EXPECT_EQ(result.regions.size(), e.planes) << e.scene;
  }
}

TEST(SceneTest, AStepWiderThanTheMergeDistanceIsSeen)
{
  // beta |d_i - d_j| >= v needs 0.375 m with the values of section V.
  for (const double gap : {0.2, 0.6}) {
    scenes::View view = scenes::step(gap);
    view.camera.resize(320, 240);
    const auto frame = scenes::render(view.scene, view.camera);
    Parameters parameters = Parameters::fromProfile(Profile::PAPER);
    parameters.tile_width = parameters.tile_height = 20;
    const PlaneSegmentation result =
        segmentPlanes(reference::toPoints(frame), parameters);
    EXPECT_EQ(result.regions.size(), gap > 0.375 ? 2U : 1U) << "gap " << gap;
    if (gap > 0.375) {
      EXPECT_GE(shareRight(frame, result), 0.99) << "gap " << gap;
    }
  }
}

TEST(SceneTest, RoomsWithKinectNoise)
{
  double sum = 0.0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto frame =
        reference::takePicture("room", 320, 240, seed, scenes::SensorNoise::kinect());
    Parameters parameters = Parameters::fromProfile(Profile::PAPER);
    parameters.tile_width = parameters.tile_height = 20;
    sum += shareRight(frame, segmentPlanes(reference::toPoints(frame), parameters));
  }
  RecordProperty("mean_share_percent", static_cast<int>(20.0 * sum));
  EXPECT_GE(sum / 5.0, 0.5) << "most of the points of a room must be on their plane";
}

/// Holes of several kinds in a picture of a room.
OrganizedPoints withHoles(const std::string& kind, int width, int height)
{
  OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", width, height, 6, scenes::SensorNoise::kinect()));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool hole = (kind == "checkerboard" && (x + y) % 2 == 0) ||
                        (kind == "rows" && y % 2 == 0) ||
                        (kind == "columns" && x % 3 == 0) ||
                        (kind == "half" && x < width / 2) || kind == "all";
      if (hole)
        points.clear(static_cast<std::size_t>(y * width + x));
    }
  return points;
}

void expectSound(const OrganizedPoints& points, const PlaneSegmentation& result)
{
  ASSERT_EQ(result.labels.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(result.labels[i] != 0, points.valid[i] != 0 && !result.regions.empty())
        << "every measured point has a plane when there is one, point " << i;
  for (const PlaneRegion& region : result.regions) {
    EXPECT_NEAR(region.plane.normal.norm(), 1.0, 1e-9);
    EXPECT_GE(region.plane.d, 0.0);
    EXPECT_TRUE(region.centroid.allFinite() && region.covariance.allFinite());
    EXPECT_TRUE(region.area >= 0.0 && region.rms >= 0.0);
  }
}

using HoleCase = std::tuple<const char*, int, int>;
class ShapeTest : public testing::TestWithParam<HoleCase> {};

INSTANTIATE_TEST_SUITE_P(Holes, ShapeTest,
                         testing::Combine(testing::Values("none", "checkerboard",
                                                          "rows", "columns", "half",
                                                          "all"),
                                          testing::Values(1, 2, 41, 160),
                                          testing::Values(1, 3, 117)));

TEST_P(ShapeTest, EveryShapeAndPatternOfHolesIsSegmented)
{
  const auto [kind, width, height] = GetParam();
  const OrganizedPoints points = withHoles(kind, width, height);
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.tile_width = parameters.tile_height = 9;
  parameters.min_valid_share = 0.3;
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  expectSound(points, result);
  for (const unsigned int threads : {2U, 5U}) {
    parameters.number_of_threads = threads;
    EXPECT_EQ(segmentPlanes(points, parameters).labels, result.labels)
        << threads << " threads";
  }
  parameters.number_of_threads = 1;
  const auto expected =
      reference::segmentAsPaper<reference::WholeUnitEnergy>(points, parameters);
  EXPECT_EQ(countDifferent(points, result, expected), 0U) << "not the reference";
}

TEST(ShapeSpecialTest, LargeImages)
{
  const auto frame =
      reference::takePicture("room", 1280, 960, 7, scenes::SensorNoise::kinect());
  const OrganizedPoints points = reference::toPoints(frame);
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.number_of_threads = 2;
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  EXPECT_GE(result.regions.size(), 3U);
  expectSound(points, result);
}

TEST(ShapeSpecialTest, DroppedPlanesLeaveTheirPointsWithoutLabel)
{
  const OrganizedPoints points = withHoles("none", 160, 120);
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.tile_width = parameters.tile_height = 10;
  const PlaneSegmentation all = segmentPlanes(points, parameters);
  ASSERT_GE(all.regions.size(), 2U);
  std::size_t smallest = points.size();
  for (const PlaneRegion& region : all.regions)
    smallest = std::min(smallest, region.indices.size());
  parameters.min_inliers = static_cast<int>(smallest) + 1;
  const PlaneSegmentation large = segmentPlanes(points, parameters);
  EXPECT_LT(large.regions.size(), all.regions.size());
  EXPECT_LT(large.report.labelled_share, 1.0);
  std::size_t labelled = 0;
  for (const std::uint16_t label : large.labels)
    labelled += label != 0 ? 1U : 0U;
  EXPECT_NEAR(large.report.labelled_share,
              static_cast<double>(labelled) / static_cast<double>(points.countValid()),
              1e-12);
}

} // namespace
} // namespace pcl_mrf_planes
