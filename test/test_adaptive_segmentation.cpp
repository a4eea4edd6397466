// SPDX-License-Identifier: BSD-3-Clause
//
// Method::ADAPTIVE on scenes with known planes.
#include "expect_sound.h"
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

TEST(AdaptiveSceneTest, FastLabelsAllPointsNearlyAsWell)
{
  for (const char* scene : {"corner", "step", "room"}) {
    const SceneFrame frame =
        reference::takePicture(scene, 640, 480, 3, SensorNoise::kinect());
    const PlaneSegmentation best = segmented(frame);
    const PlaneSegmentation fast =
        segmented(frame, Parameters::fromProfile(Profile::FAST));
    expectSound(reference::toPoints(frame), fast);
    EXPECT_GE(shareRight(frame, fast), shareRight(frame, best) - 0.05) << scene;
    EXPECT_GE(shareOfNone(frame, fast), shareOfNone(frame, best) - 0.1) << scene;
    EXPECT_LE(shareOfStripes(reference::toPoints(frame), fast), 0.01) << scene;
  }
}

/// A wall two metres away, and in the middle a third of it something at another depth.
OrganizedPoints wallWith(double depth_in_the_middle)
{
  constexpr int WIDTH = 180;
  constexpr int HEIGHT = 120;
  OrganizedPoints points;
  points.resize(WIDTH, HEIGHT);
  for (int v = 0; v < HEIGHT; ++v)
    for (int u = 0; u < WIDTH; ++u) {
      const double z = u / (WIDTH / 3) == 1 ? depth_in_the_middle : 2.0;
      points.set(static_cast<std::size_t>(v * WIDTH + u),
                 static_cast<float>((u - WIDTH / 2) * z / WIDTH),
                 static_cast<float>((v - HEIGHT / 2) * z / WIDTH),
                 static_cast<float>(z));
    }
  return points;
}

TEST(AdaptiveSceneTest, PartsOfAWallJoinBehindAPostAndNotAcrossAnOpening)
{
  Parameters parameters;
  EXPECT_EQ(segmentPlanes(wallWith(1.5), parameters).regions.size(), 2U)
      << "the post hides that the wall goes on";
  EXPECT_EQ(segmentPlanes(wallWith(2.5), parameters).regions.size(), 3U)
      << "what is seen between the parts lies behind them";
  parameters.adaptive.join_over_occluders = false;
  EXPECT_EQ(segmentPlanes(wallWith(1.5), parameters).regions.size(), 3U);
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
  EXPECT_EQ(report.iterations, Parameters().adaptive.passes);
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
  EXPECT_EQ(stages, (std::set<std::string>{"tiles", "merging", "cells", "field",
                                           "propagation", "refinement", "regions"}));
  EXPECT_GT(report.totalMs(), 0.0);
}

} // namespace
} // namespace pcl_mrf_planes
