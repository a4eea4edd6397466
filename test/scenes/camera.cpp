// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/camera.h"

#include <cmath>

namespace pcl_mrf_planes::scenes {

namespace {

constexpr double PI = 3.14159265358979323846;

Eigen::Vector3d directionOf(const Pinhole& pinhole, int, int, double u, double v)
{
  return {(u - pinhole.cx) / pinhole.fx, (v - pinhole.cy) / pinhole.fy, 1.0};
}

Eigen::Vector3d directionOf(const Spherical& angles, int width, int height, double u,
                            double v)
{
  const double across = (u + 0.5) / width;
  const double down = (v + 0.5) / height;
  const double azimuth =
      angles.azimuth_left + across * (angles.azimuth_right - angles.azimuth_left);
  const double elevation =
      angles.elevation_top + down * (angles.elevation_bottom - angles.elevation_top);
  return {std::cos(elevation) * std::cos(azimuth),
          std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

} // namespace

Pinhole Pinhole::kinect(int width, int height)
{
  const double f = 525.0 * width / 640.0;
  return {f, f, (width - 1) / 2.0, (height - 1) / 2.0};
}

Spherical Spherical::lidar()
{
  return {PI, -PI, PI / 8.0, -PI / 8.0};
}

Eigen::Vector3d Camera::direction(double u, double v) const
{
  return std::visit(
      [&](const auto& p) -> Eigen::Vector3d {
        return directionOf(p, width, height, u, v);
      },
      projection);
}

void Camera::resize(int new_width, int new_height)
{
  width = new_width;
  height = new_height;
  if (isPinhole())
    projection = Pinhole::kinect(width, height);
}

void Camera::makeLidar(int new_width, int new_height, const Spherical& angles)
{
  Eigen::Vector3d forward =
      to_world.linear() * directionOf(Pinhole{1, 1, 0, 0}, 1, 1, 0, 0);
  forward.z() = 0.0;
  forward.normalize();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  to_world.linear().col(0) = forward;
  to_world.linear().col(1) = up.cross(forward);
  to_world.linear().col(2) = up;
  width = new_width;
  height = new_height;
  projection = angles;
}

Camera lookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target)
{
  const Eigen::Vector3d forward = (target - position).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Camera camera;
  camera.to_world.linear().col(0) = right;
  camera.to_world.linear().col(1) = forward.cross(right);
  camera.to_world.linear().col(2) = forward;
  camera.to_world.translation() = position;
  return camera;
}

} // namespace pcl_mrf_planes::scenes
