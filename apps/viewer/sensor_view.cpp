// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_view.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::viewer {

namespace {

double quantile(std::vector<double>& values, double share)
{
  if (values.empty())
    return 1.0;
  const auto rank =
      static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

Eigen::Vector3d directionOf(const OrganizedPoints& points, int x, int y)
{
  const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(points.width) +
                 static_cast<std::size_t>(x);
  if (points.valid[i] == 0)
    return Eigen::Vector3d::Zero();
  return Eigen::Vector3f(points.x[i], points.y[i], points.z[i])
      .cast<double>()
      .normalized();
}

/// The axis of a scan: columns of its image run down along it. What they have across it
/// goes to all sides.
Eigen::Vector3d axisOf(const OrganizedPoints& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 1; y < points.height; ++y)
    for (int x = 0; x < points.width; ++x) {
      const Eigen::Vector3d above = directionOf(points, x, y - 1);
      const Eigen::Vector3d below = directionOf(points, x, y);
      if (!above.isZero() && !below.isZero())
        sum += above - below;
    }
  return sum.norm() > 1e-9 ? Eigen::Vector3d(sum.normalized())
                           : Eigen::Vector3d(Eigen::Vector3d::UnitZ());
}

/// Where the middle of the image looks, across the axis.
Eigen::Vector3d forwardOf(const OrganizedPoints& points, const Eigen::Vector3d& up)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < points.height; ++y)
    for (int x = points.width * 3 / 8; x < points.width * 5 / 8; ++x)
      sum += directionOf(points, x, y);
  const Eigen::Vector3d across = sum - sum.dot(up) * up;
  return across.norm() > 1e-9 ? Eigen::Vector3d(across.normalized())
                              : up.unitOrthogonal();
}

/// Over the shoulder of the sensor, far enough back to see what lies around it.
SensorView scanView(const OrganizedPoints& points, double reach)
{
  constexpr double BACK = 1.3; // in reaches
  constexpr double UP = 1.1;
  SensorView view;
  view.up = axisOf(points);
  view.focus = Eigen::Vector3d::Zero();
  view.position = reach * (UP * view.up - BACK * forwardOf(points, view.up));
  return view;
}

/// From the frame of the sensor to that of the cloud.
Eigen::Isometry3d poseOf(const ViewFrame& frame)
{
  Eigen::Quaterniond turn = frame.cloud->sensor_orientation_.cast<double>();
  if (!(turn.norm() > 0.5 && turn.norm() < 2.0)) // an unset one is no rotation
    turn.setIdentity();
  turn.normalize();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn.toRotationMatrix();
  pose.translation() = frame.cloud->sensor_origin_.head<3>().cast<double>();
  return pose;
}

SensorView moved(const SensorView& view, const Eigen::Isometry3d& pose)
{
  SensorView result = view;
  result.position = pose * view.position;
  result.focus = pose * view.focus;
  result.up = pose.linear() * view.up;
  return result;
}

bool goesAround(const OrganizedPoints& points)
{
  return points.depth_measure == DepthMeasure::RANGE;
}

/// Up and forward of the sensor, in its own frame.
std::pair<Eigen::Vector3d, Eigen::Vector3d> axesOf(const OrganizedPoints& points)
{
  if (!goesAround(points))
    return {-Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const Eigen::Vector3d up = axisOf(points);
  return {up, forwardOf(points, up)};
}

/// Half of what lies along \a axis, and its middle; a few points at either end may be stray.
std::pair<double, double> extentAlong(const OrganizedPoints& points,
                                      const Eigen::Vector3d& axis)
{
  std::vector<double> places;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      places.push_back(axis.dot(
          Eigen::Vector3f(points.x[i], points.y[i], points.z[i]).cast<double>()));
  const double low = quantile(places, 0.003);
  const double high = quantile(places, 0.997);
  return {std::max(1e-6, 0.5 * (high - low)), 0.5 * (high + low)};
}

/// All in the frame of the sensor.
SensorView lookAlong(const OrganizedPoints& points, const Eigen::Vector3d& normal)
{
  constexpr double FAR = 60.0; // in extents: hardly a perspective
  constexpr double ROOM = 1.1; // for the stray ones, and for points that are moved
  constexpr double ASTRAY = 0.8;
  const auto [up, forward] = axesOf(points);
  const Eigen::Vector3d wanted = std::abs(normal.dot(up)) > ASTRAY ? forward : up;
  SensorView view;
  view.up = (wanted - wanted.dot(normal) * normal).normalized();
  const Eigen::Vector3d right = view.up.cross(normal);
  const auto [half_across, x] = extentAlong(points, right);
  const auto [half_along, y] = extentAlong(points, view.up);
  const auto [half_deep, z] = extentAlong(points, normal);
  view.focus = x * right + y * view.up + z * normal;
  const double distance = FAR * std::max({half_across, half_along, half_deep});
  view.position = view.focus + distance * normal;
  view.across = ROOM * half_across / (distance - half_deep);
  view.along = ROOM * half_along / (distance - half_deep);
  return view;
}

} // namespace

SensorView sensorView(const ViewFrame& frame)
{
  const OrganizedPoints& points = frame.points;
  std::vector<double> depths, across, along;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.valid[i] == 0)
      continue;
    depths.push_back(static_cast<double>(points.depth(i)));
    const auto z = static_cast<double>(std::max(1e-3f, std::abs(points.z[i])));
    across.push_back(std::abs(static_cast<double>(points.x[i])) / z);
    along.push_back(std::abs(static_cast<double>(points.y[i])) / z);
  }
  const Eigen::Isometry3d pose = poseOf(frame);
  if (goesAround(points))
    return moved(scanView(points, quantile(depths, 0.75)), pose);
  const double depth = quantile(depths, 0.5);
  SensorView view;
  view.focus = Eigen::Vector3d(0.0, 0.0, depth);
  view.position = Eigen::Vector3d(0.0, 0.0, -0.05 * depth);
  view.up = -Eigen::Vector3d::UnitY();
  view.across = std::min(2.0, quantile(across, 0.99));
  view.along = std::min(2.0, quantile(along, 0.99));
  return moved(view, pose);
}

SensorView viewAlong(const ViewFrame& frame, const Eigen::Vector3d& normal)
{
  const Eigen::Isometry3d pose = poseOf(frame);
  return moved(lookAlong(frame.points, pose.linear().transpose() * normal), pose);
}

SensorView viewFromAbove(const ViewFrame& frame)
{
  return moved(lookAlong(frame.points, axesOf(frame.points).first), poseOf(frame));
}

} // namespace pcl_mrf_planes::viewer
