// SPDX-License-Identifier: BSD-3-Clause
/** \file Where the camera stands and what it holds. */
#include "sensor_view.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl_mrf_planes::test {

namespace {

using namespace viewer;

constexpr double PI = 3.14159265358979;

/// Of a scan that goes around, or of a camera's image, in a frame turned and moved.
ViewFrame frameOf(int width, int height, DepthMeasure measure,
                  const Eigen::Isometry3d& pose)
{
  ViewFrame frame;
  frame.cloud.reset(new pcl::PointCloud<pcl::PointXYZ>);
  frame.cloud->sensor_orientation_ = Eigen::Quaternionf(pose.rotation().cast<float>());
  frame.cloud->sensor_origin_.head<3>() = pose.translation().cast<float>();
  frame.points.resize(width, height);
  frame.points.depth_measure = measure;
  return frame;
}

void set(ViewFrame& frame, int i, const Eigen::Vector3d& p)
{
  const Eigen::Vector3f q = p.cast<float>();
  frame.points.set(static_cast<std::size_t>(i), q.x(), q.y(), q.z());
}

/// A wall 3 m wide and 2 m high, 2 to 4 m ahead: it leads away to the right.
ViewFrame wallFrame(const Eigen::Isometry3d& pose = Eigen::Isometry3d::Identity())
{
  ViewFrame frame = frameOf(40, 30, DepthMeasure::OPTICAL_AXIS, pose);
  for (int i = 0; i < 40 * 30; ++i) {
    const double u = (i % 40) / 39.0;
    const double v = (i / 40) / 29.0;
    set(frame, i, {3.0 * u - 1.5, 2.0 * v - 1.0, 2.0 + 2.0 * u});
  }
  return frame;
}

/// Where a point is seen: across and along, -1 to 1 within what the view holds.
Eigen::Vector2d place(const SensorView& view, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d ahead = (view.focus - view.position).normalized();
  const Eigen::Vector3d right = ahead.cross(view.up).normalized();
  const Eigen::Vector3d off = p - view.position;
  return {off.dot(right) / off.dot(ahead) / view.across,
          off.dot(right.cross(ahead)) / off.dot(ahead) / view.along};
}

Eigen::Isometry3d somePose()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond(0.2, -0.4, 0.7, 0.5).normalized().matrix();
  pose.translation() = Eigen::Vector3d(7.0, -3.0, 1.0);
  return pose;
}

TEST(SensorView, LooksDownOnAScanWhateverTheAxesOfItsFile)
{
  const Eigen::Quaterniond turns[] = {
      Eigen::Quaterniond::Identity(),
      Eigen::Quaterniond(Eigen::AngleAxisd(PI / 2, Eigen::Vector3d::UnitX())),
      Eigen::Quaterniond(0.2, -0.4, 0.7, 0.5).normalized()};
  for (const Eigen::Quaterniond& turn : turns) {
    ViewFrame frame =
        frameOf(128, 16, DepthMeasure::RANGE, Eigen::Isometry3d::Identity());
    for (int i = 0; i < 128 * 16; ++i) {
      const double azimuth = PI - 2.0 * PI * (i % 128) / 128.0; // forward is the middle
      const double height = 0.3 - 0.05 * (i / 128);             // the rows go down
      set(frame, i,
          10.0 *
              (turn * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), height)));
    }
    const SensorView view = sensorView(frame);
    EXPECT_GT(view.up.dot(turn * Eigen::Vector3d::UnitZ()), 0.99);
    const Eigen::Vector3d from = turn.inverse() * view.position;
    EXPECT_GT(from.z(), 3.0) << "above";
    EXPECT_LT(from.x(), -3.0) << "behind, looking to where the middle of the image is";
    EXPECT_NEAR(from.y(), 0.0, 1.0);
    const Eigen::Vector3d down = turn.inverse() * viewFromAbove(frame).position;
    EXPECT_GT(down.normalized().z(), 0.99) << "straight above";
  }
}

TEST(SensorView, FacingAPlaneHoldsAllOfIt)
{
  const ViewFrame frame = wallFrame();
  const Eigen::Vector3d normal = Eigen::Vector3d(2.0, 0.0, -3.0).normalized();
  const SensorView view = viewAlong(frame, normal);
  EXPECT_GT((view.position - view.focus).normalized().dot(normal), 0.999);
  EXPECT_GT(view.up.dot(-Eigen::Vector3d::UnitY()), 0.999) << "the sensor's up";
  double widest = 0.0, highest = 0.0;
  for (std::size_t i = 0; i < frame.points.size(); ++i) {
    const Eigen::Vector2d seen =
        place(view, {frame.points.x[i], frame.points.y[i], frame.points.z[i]});
    widest = std::max(widest, std::abs(seen.x()));
    highest = std::max(highest, std::abs(seen.y()));
  }
  for (const double extent : {widest, highest}) {
    EXPECT_LT(extent, 1.0) << "nothing is cut off";
    EXPECT_GT(extent, 0.8) << "and it fills the view";
  }
}

TEST(SensorView, FromAboveAWallIsALine)
{
  const ViewFrame frame = wallFrame();
  const SensorView view = viewFromAbove(frame);
  EXPECT_LT(view.position.y(), -10.0) << "y points down";
  EXPECT_GT(view.up.z(), 0.999) << "what lies ahead is up";
  for (int x = 0; x < 40; ++x) {
    const auto top = static_cast<std::size_t>(x);
    const std::size_t bottom = top + 29 * 40;
    const auto seen = [&](std::size_t i) {
      return place(view, {frame.points.x[i], frame.points.y[i], frame.points.z[i]});
    };
    EXPECT_LT((seen(top) - seen(bottom)).norm(), 0.03) << x;
  }
}

TEST(SensorView, GoesWithThePoseOfTheSensor)
{
  const ViewFrame still = wallFrame();
  const Eigen::Isometry3d pose = somePose();
  const ViewFrame moved = wallFrame(pose);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.1, -0.9).normalized();
  const auto expectMoved = [&](const SensorView& from, const SensorView& to) {
    EXPECT_LT((pose * from.position - to.position).norm(), 1e-3);
    EXPECT_LT((pose * from.focus - to.focus).norm(), 1e-3);
    EXPECT_LT((pose.linear() * from.up - to.up).norm(), 1e-5);
    EXPECT_NEAR(from.across, to.across, 1e-9);
  };
  expectMoved(sensorView(still), sensorView(moved));
  expectMoved(viewFromAbove(still), viewFromAbove(moved));
  expectMoved(viewAlong(still, normal), viewAlong(moved, pose.linear() * normal));
}

} // namespace

} // namespace pcl_mrf_planes::test
