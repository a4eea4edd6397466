// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_projection.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_mrf_planes {
namespace {

TEST(PlaneProjectionTest, PointsLandOnTheirPlane)
{
  scenes::Random random(1);
  for (int run = 0; run < 200; ++run) {
    const Plane plane = reference::randomPlane(random);
    const Eigen::Vector3d p = 2.0 * reference::randomUnit(random);
    const Eigen::Vector3d nearest = projectPoint(p, plane, ProjectionWay::NORMAL);
    EXPECT_NEAR(plane.distance(nearest), 0.0, 1e-12);
    EXPECT_LT((nearest - p).cross(plane.normal).norm(), 1e-12) << "along the normal";
    const Eigen::Vector3d seen = projectPoint(p, plane, ProjectionWay::RAY);
    EXPECT_NEAR(plane.distance(seen), 0.0, 1e-9);
    if ((seen - nearest).norm() > 1e-9) {
      EXPECT_LT(seen.cross(p).norm(), 1e-9 * seen.norm() * p.norm()) << "along the ray";
    }
  }
}

TEST(PlaneProjectionTest, GrazingRaysDoNotCarryPointsAway)
{
  const Plane floor = {{0, -1, 0}, 1e-3}; // a millimetre below the sensor
  const Eigen::Vector3d p(0, 2e-3, 5);
  EXPECT_LT((projectPoint(p, floor, ProjectionWay::RAY) - p).norm(), 2e-3);
}

TEST(PlaneProjectionTest, NoPointLandsBehindTheSensor)
{
  const Plane floor = {{0, 0, 1}, 2}; // two metres below the sensor
  const Eigen::Vector3d above(55, 0, 6);
  const Eigen::Vector3d nearest(55, 0, -2);
  EXPECT_LT((projectPoint(above, floor, ProjectionWay::RAY) - nearest).norm(), 1e-12);
  const Plane through = {{0, 0, 1}, 0}; // all rays meet at the sensor
  EXPECT_LT(
      (projectPoint(above, through, ProjectionWay::RAY) - Eigen::Vector3d(55, 0, 0))
          .norm(),
      1e-12);
  std::vector<float> points = {55, 0, 6, 55, 0, -1};
  projectPoints(floor, Eigen::Vector3d::Zero(), ProjectionWay::RAY, {0, 1}, 3,
                points.data());
  EXPECT_EQ(points, (std::vector<float>{55, 0, -2, 110, 0, -2})) << "in vectors";
}

TEST(PlaneProjectionTest, NoiseOfTheDepthGoes)
{
  scenes::View view = scenes::corner();
  view.camera.resize(320, 240);
  const auto exact = scenes::render(view.scene, view.camera);
  const auto noisy =
      scenes::render(view.scene, view.camera, scenes::SensorNoise::gaussian(0.008), 2);
  OrganizedPoints points = reference::toPoints(noisy);
  const OrganizedPoints before = points;
  const PlaneSegmentation result = segmentPlanes(points, Parameters());
  projectOntoPlanes(result.regions, ProjectionWay::RAY, points);
  double squares_before = 0;
  double squares_after = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (result.labels[i] == 0) {
      ASSERT_EQ(points.z[i], before.z[i]) << "a point of no plane stays";
      continue;
    }
    squares_before += std::pow(before.z[i] - exact.z[i], 2);
    squares_after += std::pow(points.z[i] - exact.z[i], 2);
  }
  EXPECT_LT(squares_after, 0.02 * squares_before) << "a seventh of the noise is left";
}

TEST(PlaneProjectionTest, TheRestIsWhatNoRegionHas)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 160, 120, 1, scenes::SensorNoise::kinect()));
  const PlaneSegmentation result = segmentPlanes(points, Parameters());
  std::vector<int> count(points.size(), 0);
  for (const PlaneRegion& region : result.regions)
    for (const int i : region.indices)
      ++count[static_cast<std::size_t>(i)];
  for (const int i : pointsOfNoPlane(points, result.labels)) {
    EXPECT_EQ(points.valid[static_cast<std::size_t>(i)], 1);
    ++count[static_cast<std::size_t>(i)];
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(count[i], points.valid[i]) << "each valid point once";
  EXPECT_EQ(pointsOfNoPlane(points, result.labels, true).size() -
                pointsOfNoPlane(points, result.labels).size(),
            points.size() - points.countValid());
}

} // namespace
} // namespace pcl_mrf_planes
