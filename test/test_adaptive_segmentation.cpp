// SPDX-License-Identifier: BSD-3-Clause
//
// Method::ADAPTIVE on scenes with known planes and on inputs of hostile shape.
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

using scenes::SceneFrame;
using scenes::SensorNoise;

SceneFrame seen(scenes::View view, const SensorNoise& noise, std::uint64_t seed = 1,
                int width = 640, int height = 480)
{
  view.camera.resize(width, height);
  return scenes::render(view.scene, view.camera, noise, seed);
}

PlaneSegmentation segmented(const SceneFrame& frame,
                            const Parameters& parameters = Parameters())
{
  return segmentPlanes(reference::toPoints(frame), parameters);
}

/// Whether two results are the same bit by bit, but for the times.
void expectSame(const PlaneSegmentation& a, const PlaneSegmentation& b)
{
  EXPECT_EQ(a.labels, b.labels);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t k = 0; k < a.regions.size(); ++k) {
    EXPECT_EQ(a.regions[k].plane.normal, b.regions[k].plane.normal) << "plane " << k;
    EXPECT_EQ(a.regions[k].plane.d, b.regions[k].plane.d) << "plane " << k;
    EXPECT_EQ(a.regions[k].area, b.regions[k].area) << "plane " << k;
    EXPECT_EQ(a.regions[k].rms, b.regions[k].rms) << "plane " << k;
    EXPECT_EQ(a.regions[k].indices, b.regions[k].indices) << "plane " << k;
  }
}

/// For each label of the result the true plane that most of its points are on, 0: none.
std::map<int, int> majorities(const SceneFrame& frame, const PlaneSegmentation& result)
{
  std::map<int, std::map<int, std::size_t>> overlap;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (result.labels[i] != 0)
      ++overlap[result.labels[i]][frame.labels[i]];
  std::map<int, int> best;
  for (const auto& label : overlap)
    best[label.first] = std::max_element(label.second.begin(), label.second.end(),
                                         [](const auto& a, const auto& b) {
                                           return a.second < b.second;
                                         })
                            ->first;
  return best;
}

/// Share of the points of true planes that are labelled, and rightly so.
double shareRight(const SceneFrame& frame, const PlaneSegmentation& result)
{
  std::map<int, int> best = majorities(frame, result);
  std::size_t points = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.labels[i] != 0) {
      ++points;
      right += result.labels[i] != 0 && best[result.labels[i]] == frame.labels[i];
    }
  return static_cast<double>(right) / static_cast<double>(points);
}

/// Share of the valid points on no plane that rightly got no label.
double shareOfNone(const SceneFrame& frame, const PlaneSegmentation& result)
{
  std::size_t points = 0;
  std::size_t none = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame.valid(i) && frame.labels[i] == 0) {
      ++points;
      none += result.labels[i] == 0 ? 1U : 0U;
    }
  return points == 0 ? 1.0 : static_cast<double>(none) / static_cast<double>(points);
}

double degreesBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180.0 / std::acos(-1.0);
}

/// Angle between a region's plane and the true one that it mostly shows.
void expectNormalsWithin(double degrees, const SceneFrame& frame,
                         const PlaneSegmentation& result)
{
  for (const auto& match : majorities(frame, result)) {
    ASSERT_NE(match.second, 0) << "label " << match.first << " shows no plane";
    const Eigen::Vector3d truth =
        frame.planes[static_cast<std::size_t>(match.second - 1)].head<3>();
    const Plane& plane =
        result.regions[static_cast<std::size_t>(match.first - 1)].plane;
    EXPECT_LT(degreesBetween(plane.normal, truth), degrees) << "label " << match.first;
  }
}

/// Share of the labelled points farther from their plane than 6 sigma of a Kinect.
double shareOfStripes(const OrganizedPoints& points, const PlaneSegmentation& result)
{
  std::size_t labelled = 0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result.labels[i] != 0) {
      const Eigen::Vector3d p(points.x[i], points.y[i], points.z[i]);
      const double limit = std::max(0.010, 6.0 * 0.001425 * p.z() * p.z());
      const Plane& plane = result.regions[result.labels[i] - 1U].plane;
      ++labelled;
      far += std::abs(plane.distance(p)) > limit ? 1U : 0U;
    }
  return labelled == 0 ? 0.0 : static_cast<double>(far) / static_cast<double>(labelled);
}

/// What holds for any input.
void expectSound(const OrganizedPoints& points, const PlaneSegmentation& result)
{
  ASSERT_EQ(result.labels.size(), points.size());
  std::vector<std::size_t> count(result.regions.size() + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LE(result.labels[i], result.regions.size()) << "point " << i;
    if (points.valid[i] == 0) {
      ASSERT_EQ(result.labels[i], 0) << "invalid point " << i;
    }
    ++count[result.labels[i]];
  }
  for (std::size_t k = 0; k < result.regions.size(); ++k) {
    const PlaneRegion& region = result.regions[k];
    EXPECT_EQ(region.indices.size(), count[k + 1]) << "plane " << k;
    EXPECT_FALSE(region.indices.empty()) << "plane " << k;
    EXPECT_NEAR(region.plane.normal.norm(), 1.0, 1e-6) << "plane " << k;
    EXPECT_GE(region.plane.d, 0.0) << "plane " << k;
    EXPECT_TRUE(region.centroid.allFinite() && region.covariance.allFinite());
    EXPECT_TRUE(region.area >= 0.0 && region.rms >= 0.0) << "plane " << k;
  }
}

TEST(AdaptiveSceneTest, ACornerIsThreePlanes)
{
  for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()})
    for (const int width : {320, 640}) {
      const SceneFrame frame = seen(scenes::corner(), noise, 3, width, 3 * width / 4);
      const PlaneSegmentation result = segmented(frame);
      const std::string which =
          (noise.kind == scenes::NoiseKind::NONE ? "exact, " : "Kinect, ") +
          std::to_string(width) + " columns";
      EXPECT_EQ(result.regions.size(), 3U) << which;
      EXPECT_GE(shareRight(frame, result), 0.98) << which;
      expectNormalsWithin(1.0, frame, result);
      expectSound(reference::toPoints(frame), result);
    }
}

TEST(AdaptiveSceneTest, AStepOfTwentyCentimetresIsTwoPlanes)
{
  for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()}) {
    const SceneFrame frame = seen(scenes::step(0.2), noise);
    const PlaneSegmentation result = segmented(frame);
    EXPECT_EQ(result.regions.size(), 2U);
    EXPECT_GE(shareRight(frame, result), 0.98);
    expectNormalsWithin(1.0, frame, result);
    EXPECT_EQ(segmented(frame, Parameters::fromProfile(Profile::PAPER)).regions.size(),
              1U)
        << "equation (5) merges planes less than 0.375 m apart";
  }
}

// With the noise of a Kinect a patch of the ball that is flat within it can stay a plane:
// 284 of 21000 points in one of three pictures of 640 columns.
TEST(AdaptiveSceneTest, ASphereIsNoPlane)
{
  for (const int width : {320, 640})
    for (const std::uint64_t seed : {1U, 2U, 3U})
      for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()}) {
        const SceneFrame frame =
            seen(scenes::sphereOnPlane(), noise, seed, width, 3 * width / 4);
        const PlaneSegmentation result = segmented(frame);
        const bool exact = noise.kind == scenes::NoiseKind::NONE;
        EXPECT_GE(result.regions.size(), 1U) << "the floor";
        EXPECT_LE(result.regions.size(), exact ? 1U : 2U) << "seed " << seed;
        EXPECT_GE(shareRight(frame, result), 0.99) << "the floor, seed " << seed;
        EXPECT_GE(shareOfNone(frame, result), exact ? 0.99 : 0.95)
            << "points of the ball have no label, seed " << seed;
      }
}

// Exact cylinders get no label. With the noise of a Kinect it is less than wished for:
// strips along a cylinder are flat within the noise and stay planes, so that only 65 % to
// 94 % of the points of the drums are without a label.
TEST(AdaptiveSceneTest, CylindersAreNoPlanes)
{
  for (const int width : {320, 640})
    for (const std::uint64_t seed : {1U, 2U, 3U})
      for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()}) {
        const SceneFrame frame =
            seen(scenes::cylinderRoom(), noise, seed, width, 3 * width / 4);
        const PlaneSegmentation result = segmented(frame);
        const bool exact = noise.kind == scenes::NoiseKind::NONE;
        EXPECT_GE(shareRight(frame, result), 0.97)
            << "walls, floor and lids, seed " << seed;
        EXPECT_GE(shareOfNone(frame, result), exact ? 0.97 : 0.6)
            << "points of drums have no label, seed " << seed;
      }
}

TEST(AdaptiveSceneTest, TreadsAndRisersAreToldApart)
{
  for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()}) {
    const SceneFrame frame = seen(scenes::stairs(), noise);
    const PlaneSegmentation result = segmented(frame);
    const auto counts = frame.labelCounts();
    std::size_t large = 0;
    for (std::size_t k = 1; k < counts.size(); ++k)
      large += counts[k] >= 2000 ? 1U : 0U;
    std::set<int> found;
    for (const auto& match : majorities(frame, result))
      found.insert(match.second);
    EXPECT_GE(found.size(), large) << "planes of 2000 points and more are all found";
    EXPECT_GE(shareRight(frame, result), 0.9);
  }
}

TEST(AdaptiveSceneTest, TheSidesOfABoxOnATableAreFound)
{
  for (const SensorNoise& noise : {SensorNoise::none(), SensorNoise::kinect()}) {
    const SceneFrame frame = seen(scenes::boxOnTable(), noise);
    const PlaneSegmentation result = segmented(frame);
    EXPECT_GE(result.regions.size(), 5U)
        << "floor, wall, table, top and side of the box";
    EXPECT_GE(shareRight(frame, result), 0.9);
  }
}

// A plane of PAPER paints stripes on whatever its extension crosses.
TEST(AdaptiveSceneTest, PlanesPaintNoStripesInRooms)
{
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const OrganizedPoints points = reference::toPoints(
        reference::takePicture("room", 640, 480, seed, SensorNoise::kinect()));
    const double share = shareOfStripes(points, segmentPlanes(points, Parameters()));
    EXPECT_LT(share, 0.01) << "room " << seed;
    const double paper = shareOfStripes(
        points, segmentPlanes(points, Parameters::fromProfile(Profile::PAPER)));
    EXPECT_GT(paper, 5.0 * share) << "room " << seed << ": no better than PAPER";
  }
}

TEST(AdaptiveSceneTest, ANoisyWallIsOnePlane)
{
  for (const double tilt : {0.0, 0.5}) {
    const SceneFrame frame =
        seen(scenes::singlePlane(2.0, tilt), SensorNoise::gaussian(0.02));
    const PlaneSegmentation result = segmented(frame);
    EXPECT_EQ(result.regions.size(), 1U) << "tilt " << tilt;
    EXPECT_GE(shareRight(frame, result), 0.98) << "tilt " << tilt;
    expectNormalsWithin(1.0, frame, result);
  }
}

TEST(AdaptiveSceneTest, AnExactWallIsOnePlane)
{
  for (const double distance : {0.5, 2.0, 20.0})
    for (const double tilt : {0.0, 0.5}) {
      const SceneFrame frame =
          seen(scenes::singlePlane(distance, tilt), SensorNoise::none());
      const PlaneSegmentation result = segmented(frame);
      EXPECT_EQ(result.regions.size(), 1U) << distance << " m, tilt " << tilt;
      EXPECT_GE(shareRight(frame, result), 0.99) << distance << " m, tilt " << tilt;
    }
}

TEST(AdaptiveOutputTest, RunsAndThreadsGiveTheSameBits)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 323, 243, 2, SensorNoise::kinect()));
  Parameters parameters;
  const PlaneSegmentation expected = segmentPlanes(points, parameters);
  ASSERT_GE(expected.regions.size(), 3U) << "too simple to prove anything";
  for (const unsigned int threads : {1U, 2U, 3U, 0U}) {
    parameters.number_of_threads = threads;
    expectSame(segmentPlanes(points, parameters), expected);
  }
  expectSame(segmentAdaptively(points, parameters), expected);
}

TEST(AdaptiveOutputTest, SmallPlanesAreDropped)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 320, 240, 4, SensorNoise::kinect()));
  Parameters parameters;
  std::size_t planes = points.size();
  for (const int least : {1, 180, 2000, 20000, 1000000}) {
    parameters.adaptive.min_points = least;
    const PlaneSegmentation result = segmentPlanes(points, parameters);
    for (const PlaneRegion& region : result.regions)
      EXPECT_GE(region.indices.size(), static_cast<std::size_t>(least))
          << "min_points " << least;
    EXPECT_LE(result.regions.size(), planes) << "min_points " << least;
    planes = result.regions.size();
  }
  EXPECT_EQ(planes, 0U) << "none has a million points";
  parameters = Parameters();
  parameters.min_inliers = 2000;
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  for (const PlaneRegion& region : result.regions)
    EXPECT_GE(region.indices.size(), 2000U) << "min_inliers holds, too";
  expectSound(points, result);
}

TEST(AdaptiveOutputTest, TheReportIsFilled)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 320, 240, 4, SensorNoise::kinect()));
  const PlaneSegmentation result = segmentPlanes(points, Parameters());
  const SegmentationReport& report = result.report;
  EXPECT_EQ(report.points, points.size());
  EXPECT_EQ(report.valid_points, points.countValid());
  EXPECT_EQ(report.planes, result.regions.size());
  EXPECT_GE(report.planes_after_merging, 1U);
  EXPECT_GE(report.tiles_kept, report.planes_after_merging);
  EXPECT_GT(report.tiles_tried, report.tiles_kept);
  EXPECT_EQ(report.iterations, 3 * 2) << "passes times rounds";
  std::size_t labelled = 0;
  for (const std::uint16_t label : result.labels)
    labelled += label != 0 ? 1U : 0U;
  EXPECT_NEAR(report.labelled_share,
              static_cast<double>(labelled) / static_cast<double>(report.valid_points),
              1e-12);
  std::set<std::string> stages;
  for (const auto& stage : report.stage_ms) {
    EXPECT_TRUE(stages.insert(stage.first).second) << stage.first << " twice";
    EXPECT_GE(stage.second, 0.0) << stage.first;
  }
  EXPECT_EQ(stages, (std::set<std::string>{"tiles", "merging", "field", "propagation",
                                           "refinement", "regions"}));
  EXPECT_GT(report.totalMs(), 0.0);
}

/// A wall 2 m away, of any size.
OrganizedPoints wall(int width, int height)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      points.set(static_cast<std::size_t>(v * width + u),
                 0.004f * static_cast<float>(u - width / 2),
                 0.004f * static_cast<float>(v - height / 2), 2.0f);
  return points;
}

/// Every point by a function of its place in the image.
OrganizedPoints made(int width, int height,
                     const std::function<Eigen::Vector3f(int, int)>& at)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3f p = at(u, v);
      points.set(static_cast<std::size_t>(v * width + u), p.x(), p.y(), p.z());
    }
  return points;
}

std::map<std::string, OrganizedPoints> hostileInputs()
{
  std::map<std::string, OrganizedPoints> inputs;
  const std::vector<std::pair<int, int>> sizes = {
      {1, 1}, {1, 97}, {97, 1}, {2, 2}, {7, 5}, {9, 8}, {3, 300}, {300, 3}, {65, 33}};
  for (const auto& size : sizes)
    inputs["wall of " + std::to_string(size.first) + "x" +
           std::to_string(size.second)] = wall(size.first, size.second);
  using Eigen::Vector3f;
  inputs["no valid point"] = made(64, 48, [](int, int) {
    return Vector3f::Constant(reference::NOT_MEASURED).eval();
  });
  inputs["all points equal"] =
      made(64, 48, [](int, int) { return Vector3f(0.1f, 0.2f, 1.5f); });
  inputs["all points at the sensor"] =
      made(64, 48, [](int, int) { return Vector3f(0, 0, 0); });
  inputs["all points on a line"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u + v), 0.3f, 2.0f);
  });
  inputs["a plane through the sensor"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u), 0.0f,
                    1.0f + 0.01f * static_cast<float>(v));
  });
  inputs["1e5 m away"] = made(64, 48, [](int u, int v) {
    return Vector3f(200.0f * static_cast<float>(u - 32),
                    200.0f * static_cast<float>(v - 24), 1e5f);
  });
  inputs["of 1e-6 m"] = made(64, 48, [](int u, int v) {
    return Vector3f(1e-8f * static_cast<float>(u - 32),
                    1e-8f * static_cast<float>(v - 24), 1e-6f);
  });
  inputs["from 1e-6 m to 1e6 m"] = made(64, 48, [](int u, int v) {
    const float z = std::pow(10.0f, static_cast<float>((u * 7 + v * 5) % 13 - 6));
    return Vector3f(0.001f * static_cast<float>(u) * z,
                    0.001f * static_cast<float>(v) * z, z);
  });
  inputs["behind the sensor"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u), 0.01f * static_cast<float>(v),
                    -2.0f);
  });
  scenes::Random random(5);
  inputs["no shape at all"] = reference::randomPoints(random, 70, 50);
  OrganizedPoints room = reference::toPoints(
      reference::takePicture("room", 125, 93, 6, SensorNoise::kinect()));
  inputs["a room"] = room;
  for (int i = 0; i < 125 * 93; ++i)
    if ((i % 125 + i / 125) % 2 == 0)
      room.clear(static_cast<std::size_t>(i));
  inputs["a checkerboard of holes"] = room;
  for (auto& input : inputs)
    input.second.resolveDepthMeasure(DepthMeasure::AUTO);
  return inputs;
}

std::map<std::string, AdaptiveParameters> extremeParameters()
{
  std::map<std::string, AdaptiveParameters> all;
  all["as they are"] = {};
  for (const int cell : {2, 8}) {
    all["cells of " + std::to_string(cell)].cell = cell;
    AdaptiveParameters& deep = all["8 levels on cells of " + std::to_string(cell)];
    deep.cell = cell;
    deep.levels = 8;
  }
  all["2 levels"].levels = 2;
  all["no passes"].passes = 0;
  all["30 passes"].passes = 30;
  all["1 round"].rounds = 1;
  all["10 rounds"].rounds = 10;
  all["no fans"].fan_parts = 0;
  all["fans of one"].fan_parts = 1;
  all["no joining"].join_coplanar = false;
  all["occluders separate"].join_over_occluders = false;
  AdaptiveParameters& greedy = all["takes everything"];
  greedy.tile_tolerance = greedy.merge_tolerance = greedy.region_tolerance = 1e6;
  greedy.accept_tolerance = greedy.join_tolerance = 1e6;
  greedy.min_fill = 0;
  greedy.min_points = 1;
  greedy.min_width = 0;
  greedy.join_gap = 1e4;
  greedy.join_seen = 1;
  greedy.local_reach = 16;
  AdaptiveParameters& choosy = all["takes next to nothing"];
  choosy.tile_tolerance = choosy.merge_tolerance = choosy.region_tolerance = 1e-6;
  choosy.accept_tolerance = choosy.join_tolerance = 1e-6;
  choosy.min_fill = 1;
  choosy.min_points = 1;
  choosy.local_reach = 0;
  AdaptiveParameters& shreds = all["tiles never merge"];
  shreds.cell = 2;
  shreds.merge_tolerance = 1e-6;
  shreds.min_points = 1;
  shreds.min_width = 0;
  shreds.fan_parts = 0;
  for (const double cost : {1e-6, 1e3})
    for (const double change : {0.0, 1e3}) {
      AdaptiveParameters& p =
          all["none " + std::to_string(cost) + ", change " + std::to_string(change)];
      p.none_cost = cost;
      p.label_change = change;
    }
  AdaptiveParameters& least = all["least noise"];
  least.noise_percentile = least.growth_percentile = least.local_percentile = 0;
  least.flatness = least.max_flatness = 0;
  least.min_sigma = 1e-9;
  least.max_growth = least.long_range = least.max_local = 1;
  least.step_sigmas = 1e-6;
  AdaptiveParameters& most = all["most noise"];
  most.noise_percentile = most.growth_percentile = most.local_percentile = 1;
  most.flatness = most.max_flatness = most.min_sigma = 1e6;
  most.max_growth = most.long_range = most.max_local = 1e6;
  most.step_sigmas = most.min_width = 1e6;
  AdaptiveParameters& no_points = all["no plane is large enough"];
  no_points.min_points = 1000000000;
  no_points.max_growth = no_points.long_range = 1e6;
  return all;
}

TEST(AdaptiveHostileTest, NoInputAndNoParametersBreakIt)
{
  const auto inputs = hostileInputs();
  for (const auto& choice : extremeParameters()) {
    Parameters parameters;
    parameters.adaptive = choice.second;
    ASSERT_EQ(parameters.validate(), "") << choice.first;
    for (const auto& input : inputs) {
      SCOPED_TRACE(input.first + ", " + choice.first);
      expectSound(input.second, segmentPlanes(input.second, parameters));
    }
  }
}

TEST(AdaptiveHostileTest, WhatIsNoPlaneGetsNone)
{
  const auto inputs = hostileInputs();
  for (const char* name : {"no valid point", "no shape at all", "wall of 1x1",
                           "wall of 2x2", "wall of 1x97", "wall of 97x1"})
    EXPECT_TRUE(segmentPlanes(inputs.at(name), Parameters()).regions.empty()) << name;
  for (const char* name : {"1e5 m away", "behind the sensor"}) {
    const PlaneSegmentation result = segmentPlanes(inputs.at(name), Parameters());
    EXPECT_EQ(result.regions.size(), 1U) << name;
    EXPECT_GE(result.report.labelled_share, 0.99) << name;
  }
}

} // namespace
} // namespace pcl_mrf_planes
