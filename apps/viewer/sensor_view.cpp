// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_view.h"

#include <algorithm>
#include <cmath>
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
  Eigen::Quaterniond turn = frame.cloud->sensor_orientation_.cast<double>();
  if (!(turn.norm() > 0.5 && turn.norm() < 2.0)) // an unset one is no rotation
    turn.setIdentity();
  turn.normalize();
  const Eigen::Vector3d origin = frame.cloud->sensor_origin_.head<3>().cast<double>();
  if (points.depth_measure == DepthMeasure::RANGE) {
    SensorView view = scanView(points, quantile(depths, 0.75));
    view.focus = origin + turn * view.focus;
    view.position = origin + turn * view.position;
    view.up = turn * view.up;
    return view;
  }
  const double depth = quantile(depths, 0.5);
  SensorView view;
  view.focus = origin + turn * Eigen::Vector3d(0.0, 0.0, depth);
  view.position = origin - turn * Eigen::Vector3d(0.0, 0.0, 0.05 * depth);
  view.up = turn * -Eigen::Vector3d::UnitY();
  view.across = std::min(2.0, quantile(across, 0.99));
  view.along = std::min(2.0, quantile(along, 0.99));
  return view;
}

} // namespace pcl_mrf_planes::viewer
