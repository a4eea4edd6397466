// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_regions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::reference {

/** \brief Labels of any shape on planes that a sensor sees. */
struct LabelledPoints {
  OrganizedPoints points;
  std::vector<Plane> planes;
  std::vector<std::uint16_t> labels; ///< index of a plane, or NO_PLANE
};

/** \brief A label image in which a pixel is like the one before or above it. */
inline std::vector<std::uint16_t> raggedLabels(scenes::Random& random, int width,
                                               int height, int count)
{
  const double same = random.uniform(0.3, 0.98);
  std::vector<std::uint16_t> labels;
  for (int i = 0; i < width * height; ++i) {
    const bool left = random.chance(0.5) ? i % width > 0 : i < width;
    const int from = left ? i - 1 : i - width;
    const int value = random.integer(0, count);
    labels.push_back(from >= 0 && random.chance(same)
                         ? labels[static_cast<std::size_t>(from)]
                     : value == count ? NO_PLANE
                                      : static_cast<std::uint16_t>(value));
  }
  return labels;
}

/** \brief A plane in front of a sensor that sees it over all of a small image. */
inline Plane facingPlane(scenes::Random& random, const Eigen::Vector3d& ahead)
{
  Plane plane;
  plane.normal = (-ahead + 0.4 * randomUnit(random)).normalized();
  plane.d = random.uniform(0.5, 3.0);
  return plane;
}

/** \brief Ragged labels with every point on the ray of its pixel and on its plane; some
 * points are not valid. */
inline LabelledPoints raggedPoints(scenes::Random& random, bool lidar)
{
  LabelledPoints out;
  scenes::Camera camera;
  camera.resize(random.integer(2, 40), random.integer(2, 30));
  camera.projection = scenes::Pinhole{50, 50, camera.width / 2.0, camera.height / 2.0};
  const scenes::Spherical angles = {0.6, -0.6, 0.4, -0.4};
  if (lidar)
    camera.makeLidar(camera.width, camera.height, angles);
  const Eigen::Vector3d ahead =
      lidar ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  for (int k = 0; k < 3; ++k)
    out.planes.push_back(facingPlane(random, ahead));
  out.labels = raggedLabels(random, camera.width, camera.height, 3);
  OrganizedPoints& points = out.points;
  points.resize(camera.width, camera.height);
  points.depth_measure = lidar ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int x = static_cast<int>(i) % camera.width;
    const int y = static_cast<int>(i) / camera.width;
    const Plane& plane = out.planes[out.labels[i] == NO_PLANE ? 0 : out.labels[i]];
    const Eigen::Vector3d ray = camera.direction(x, y);
    const Eigen::Vector3d p = -plane.d / plane.normal.dot(ray) * ray;
    if (!random.chance(0.05))
      points.set(i, static_cast<float>(p.x()), static_cast<float>(p.y()),
                 static_cast<float>(p.z()));
  }
  return out;
}

} // namespace pcl_mrf_planes::reference
