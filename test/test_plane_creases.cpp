// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_creases.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes {
namespace {

std::vector<PlaneRegion> trueRegions(const scenes::SceneFrame& frame,
                                     const OrganizedPoints& points)
{
  std::vector<Plane> planes;
  for (const Eigen::Vector4d& abcd : frame.planes)
    planes.push_back({abcd.head<3>(), abcd[3]});
  std::vector<std::uint16_t> labels;
  for (const std::uint16_t label : frame.labels)
    labels.push_back(label == 0 ? NO_PLANE : static_cast<std::uint16_t>(label - 1));
  return gatherRegions(points, planes, labels, 1);
}

TEST(IntersectPlanesTest, PointAndDirectionLieInBothPlanes)
{
  scenes::Random random(1);
  for (int run = 0; run < 200; ++run) {
    const Plane a = reference::randomPlane(random);
    const Plane b = reference::randomPlane(random);
    const Eigen::Vector3d near = 3.0 * reference::randomUnit(random);
    Eigen::Vector3d point;
    Eigen::Vector3d direction;
    ASSERT_TRUE(intersectPlanes(a, b, near, point, direction));
    EXPECT_NEAR(direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(a.distance(point), 0.0, 1e-7);
    EXPECT_NEAR(b.distance(point + direction), 0.0, 1e-7);
    EXPECT_NEAR((point - near).dot(direction), 0.0, 1e-7) << "the nearest point";
  }
  const Plane plane = reference::randomPlane(random);
  Eigen::Vector3d unused;
  EXPECT_FALSE(intersectPlanes(plane, plane, unused, unused, unused)) << "parallel";
}

TEST(PlaneAnglesTest, AnglesAndDistancesAreThoseOfTheScene)
{
  const Plane floor = {{0, 0, 1}, 1};
  const Plane wall = {{1, 0, 0}, 2};
  const Plane ceiling = {{0, 0, -1}, 1.5};
  EXPECT_NEAR(normalAngle(floor, wall), M_PI / 2, 1e-12);
  EXPECT_NEAR(normalAngle(floor, ceiling), M_PI, 1e-12);
  EXPECT_EQ(normalAngle(floor, floor), 0.0);
  PlaneRegion low;
  low.plane = floor;
  low.centroid = {0, 0, -1};
  PlaneRegion high;
  high.plane = ceiling;
  high.centroid = {5, 5, 1.5};
  EXPECT_NEAR(planeDistance(low, high), 2.5, 1e-12);
}

// Boxes of known size, straight ahead, without noise: every crease is known.
TEST(PlaneCreasesTest, EdgesOfABoxAreFoundWithTheirEndPoints)
{
  scenes::Scene scene;
  scene.beginObject();
  const scenes::Colour gray(0.5, 0.5, 0.5);
  // Camera frame is x right, y down, z ahead; the world is x right, y ahead, z up.
  const Eigen::Vector3d a(-0.5, 2, -0.3);
  scene.addPolygon({a, a + Eigen::Vector3d(1, 0, 0), a + Eigen::Vector3d(1, 0, 0.4),
                    a + Eigen::Vector3d(0, 0, 0.4)},
                   gray); // front
  scene.addPolygon({a + Eigen::Vector3d(0, 0, 0.4), a + Eigen::Vector3d(1, 0, 0.4),
                    a + Eigen::Vector3d(1, 1, 0.4), a + Eigen::Vector3d(0, 1, 0.4)},
                   gray); // top
  const auto frame = scenes::render(scene, scenes::lookAt({0, 0, 1}, {0, 2, 0}));
  const OrganizedPoints points = reference::toPoints(frame);
  const auto regions = trueRegions(frame, points);
  ASSERT_EQ(regions.size(), 2U);
  const auto creases = findCreases(points, regions);
  ASSERT_EQ(creases.size(), 1U);
  const PlaneCrease& crease = creases[0];
  EXPECT_NEAR(crease.angle, M_PI / 2, 1e-6);
  EXPECT_TRUE(crease.convex) << "an edge of a box";
  EXPECT_NEAR(crease.length(), 1.0, 0.02);
  const Eigen::Isometry3d& pose = frame.camera.to_world;
  for (const Eigen::Vector3d& end : {crease.start, crease.end}) {
    const Eigen::Vector3d p = pose * end;
    EXPECT_NEAR(std::abs(p.x()), 0.5, 0.01);
    EXPECT_NEAR(p.y(), 2.0, 1e-4);
    EXPECT_NEAR(p.z(), 0.1, 1e-4);
  }
}

TEST(PlaneCreasesTest, MoveWithTheirPlanes)
{
  scenes::Random random(8);
  for (int run = 0; run < 50; ++run) {
    SensorPose pose;
    pose.rotation =
        Eigen::AngleAxisd(3.0 * random.uniform(), reference::randomUnit(random))
            .toRotationMatrix();
    pose.origin = 5.0 * reference::randomUnit(random);
    const Plane a = reference::randomPlane(random);
    const Plane b = reference::randomPlane(random);
    PlaneCrease crease;
    Eigen::Vector3d along;
    ASSERT_TRUE(intersectPlanes(a, b, {0, 0, 2}, crease.start, along));
    crease.end = crease.start + 0.4 * along;
    crease.angle = normalAngle(a, b);
    const PlaneCrease moved = inCloudFrame(crease, pose);
    for (const Plane& plane : {a, b}) {
      Plane there;
      there.normal = pose.rotation * plane.normal;
      there.d = plane.d - there.normal.dot(pose.origin);
      EXPECT_NEAR(there.distance(moved.start), 0.0, 1e-6);
      EXPECT_NEAR(there.distance(moved.end), 0.0, 1e-6);
    }
    EXPECT_NEAR(moved.length(), 0.4, 1e-9);
    EXPECT_EQ(moved.angle, crease.angle);
  }
}

// A wall goes on behind the jamb of its door: most of it, and its centroid, lie before the
// jamb's plane, though where they meet is an edge; and beyond it is a corner.
TEST(PlaneCreasesTest, EdgesAreToldFromCornersWhereTheyAre)
{
  scenes::Scene scene;
  scene.beginObject();
  const scenes::Colour gray(0.5, 0.5, 0.5);
  const auto wall = [&](double from, double to, double y) {
    scene.addPolygon({{from, y, -1}, {to, y, -1}, {to, y, 1}, {from, y, 1}}, gray);
  };
  wall(-2, 0, 2);
  wall(0.4, 0.8, 2);
  wall(0, 0.4, 2.5); // the door
  scene.addPolygon({{0.4, 2, -1}, {0.4, 2.5, -1}, {0.4, 2.5, 1}, {0.4, 2, 1}}, gray);
  for (const double sigma : {0.0, 0.004}) {
    const auto frame = scenes::render(scene, scenes::lookAt({-0.6, 0, 0}, {-0.2, 2, 0}),
                                      scenes::SensorNoise::gaussian(sigma), 1);
    const OrganizedPoints points = reference::toPoints(frame);
    auto frame_of_wholes = frame; // both parts of the wall are one plane
    for (std::uint16_t& label : frame_of_wholes.labels)
      for (std::uint16_t k = 1; k < label; ++k)
        if (frame.planes[k - 1U].isApprox(frame.planes[label - 1U], 1e-6))
          label = k;
    const auto regions = trueRegions(frame_of_wholes, points);
    ASSERT_EQ(regions.size(), 3U) << "wall, door, jamb";
    int edges = 0, corners = 0;
    for (const PlaneCrease& crease : findCreases(points, regions)) {
      const Eigen::Vector3d middle =
          frame.camera.to_world * Eigen::Vector3d(0.5 * (crease.start + crease.end));
      EXPECT_NEAR(middle.x(), 0.4, 0.03);
      const bool is_edge = middle.y() < 2.25;
      EXPECT_EQ(crease.convex, is_edge) << middle.transpose();
      ++(is_edge ? edges : corners);
    }
    EXPECT_GT(edges, 0);
    EXPECT_GT(corners, 0);
  }
}

TEST(PlaneCreasesTest, ARoomsCornerHasThreeThatMeet)
{
  scenes::View view = scenes::corner();
  for (const double sigma : {0.0, 0.003}) {
    const auto frame = scenes::render(view.scene, view.camera,
                                      scenes::SensorNoise::gaussian(sigma), 3);
    const OrganizedPoints points = reference::toPoints(frame);
    const auto regions = segmentPlanes(points, Parameters()).regions;
    ASSERT_EQ(regions.size(), 3U);
    const auto creases = findCreases(points, regions);
    ASSERT_EQ(creases.size(), 3U);
    Eigen::Vector3d meeting = Eigen::Vector3d::Zero();
    for (const PlaneCrease& crease : creases) {
      EXPECT_FALSE(crease.convex) << "walls and floor of a room";
      EXPECT_NEAR(crease.angle, M_PI / 2, 0.02);
      EXPECT_GT(crease.length(), 0.5);
      EXPECT_LT(crease.first, crease.second);
      for (const Eigen::Vector3d& p : {crease.start, crease.end}) {
        EXPECT_NEAR(regions[crease.first].plane.distance(p), 0.0, 1e-9);
        EXPECT_NEAR(regions[crease.second].plane.distance(p), 0.0, 1e-9);
      }
    }
    // The corner itself: every crease has an end near the same point.
    Eigen::Matrix3d normals;
    Eigen::Vector3d offsets;
    for (int k = 0; k < 3; ++k) {
      const Plane& plane = regions[static_cast<std::size_t>(k)].plane;
      normals.row(k) = plane.normal.transpose();
      offsets[k] = -plane.d;
    }
    meeting = normals.inverse() * offsets;
    for (const PlaneCrease& crease : creases)
      EXPECT_LT(
          std::fmin((crease.start - meeting).norm(), (crease.end - meeting).norm()),
          0.05);
  }
}

TEST(PlaneCreasesTest, WhatStandsInFrontMeetsNothing)
{
  scenes::View view = scenes::step(0.3, 2.0);
  const auto frame = scenes::render(view.scene, view.camera);
  const OrganizedPoints points = reference::toPoints(frame);
  EXPECT_TRUE(findCreases(points, trueRegions(frame, points)).empty())
      << "parallel walls";

  // A board that leans before a wall which it does not touch.
  scenes::Scene scene;
  scene.beginObject();
  const scenes::Colour gray(0.5, 0.5, 0.5);
  scene.addPolygon({{-3, 3, -3}, {3, 3, -3}, {3, 3, 3}, {-3, 3, 3}}, gray);
  scene.addPolygon(
      {{-0.4, 1.5, -0.4}, {0.4, 1.5, -0.4}, {0.4, 1.9, 0.4}, {-0.4, 1.9, 0.4}}, gray);
  const auto leaning = scenes::render(scene, scenes::lookAt({0, 0, 0}, {0, 1, 0}));
  const OrganizedPoints seen = reference::toPoints(leaning);
  const auto regions = trueRegions(leaning, seen);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_TRUE(findCreases(seen, regions).empty());
}

TEST(PlaneCreasesTest, ABrokenBorderIsSeveralCreases)
{
  // A floor and a wall with a thing before the middle of their crease.
  scenes::Scene scene;
  scene.beginObject();
  const scenes::Colour gray(0.5, 0.5, 0.5);
  scene.addPolygon({{-1, 0.5, -1}, {1, 0.5, -1}, {1, 2.5, -1}, {-1, 2.5, -1}}, gray);
  scene.addPolygon({{-1, 2.5, -1}, {1, 2.5, -1}, {1, 2.5, 1}, {-1, 2.5, 1}}, gray);
  scene.beginObject();
  scene.addCurved(scenes::Sphere{{0, 2.2, -0.8}, 0.3}, gray);
  const auto frame = scenes::render(scene, scenes::lookAt({0, 0, 0}, {0, 2, -0.8}));
  const OrganizedPoints points = reference::toPoints(frame);
  const auto creases = findCreases(points, trueRegions(frame, points));
  ASSERT_EQ(creases.size(), 2U) << "left and right of the ball";
  EXPECT_LT(creases[0].length() + creases[1].length(), 1.6);
  CreaseParameters wide;
  wide.max_gap = 1.0;
  EXPECT_EQ(findCreases(points, trueRegions(frame, points), wide).size(), 1U);
}

TEST(PlaneCreasesTest, LeavesOutPiecesOfTooFewPointsAndNoOthers)
{
  scenes::View view = scenes::corner();
  const auto frame = scenes::render(view.scene, view.camera);
  const OrganizedPoints points = reference::toPoints(frame);
  const auto regions = trueRegions(frame, points);
  CreaseParameters parameters;
  parameters.min_points = 1;
  const auto all = findCreases(points, regions, parameters);
  ASSERT_EQ(all.size(), 3U);
  for (const PlaneCrease& limit : all)
    for (const int more : {0, 1}) {
      parameters.min_points = limit.points + more;
      const auto expected = std::count_if(all.begin(), all.end(), [&](const auto& c) {
        return c.points >= parameters.min_points;
      });
      EXPECT_EQ(findCreases(points, regions, parameters).size(),
                static_cast<std::size_t>(expected))
          << "of " << parameters.min_points << " points or more";
    }
}

TEST(CreaseParametersTest, WhatCannotBeIsRefused)
{
  CreaseParameters parameters;
  EXPECT_TRUE(parameters.validate().empty());
  parameters.tolerance = 0;
  EXPECT_NE(parameters.validate().find("tolerance"), std::string::npos);
  parameters = {};
  parameters.min_angle = 2;
  EXPECT_FALSE(parameters.validate().empty());
  parameters.min_angle = -0.1;
  EXPECT_NE(parameters.validate().find("angle"), std::string::npos);
  parameters = {};
  parameters.max_gap = 0;
  EXPECT_NE(parameters.validate().find("gap"), std::string::npos);
  parameters = {};
  parameters.reach = -1;
  EXPECT_NE(parameters.validate().find("reach"), std::string::npos);
  parameters = {};
  parameters.min_points = 0;
  EXPECT_FALSE(parameters.validate().empty());
}

} // namespace
} // namespace pcl_mrf_planes
