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
  const double depth = quantile(depths, 0.5);
  SensorView view;
  if (points.depth_measure == DepthMeasure::RANGE) {
    view.focus = origin;
    view.position = origin + turn * Eigen::Vector3d(-2.0, 0.0, 1.5) * depth;
    view.up = turn * Eigen::Vector3d::UnitZ();
    return view;
  }
  view.focus = origin + turn * Eigen::Vector3d(0.0, 0.0, depth);
  view.position = origin - turn * Eigen::Vector3d(0.0, 0.0, 0.05 * depth);
  view.up = turn * -Eigen::Vector3d::UnitY();
  view.across = std::min(2.0, quantile(across, 0.99));
  view.along = std::min(2.0, quantile(along, 0.99));
  return view;
}

} // namespace pcl_mrf_planes::viewer
