// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/random.h"
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <pcl_mrf_planes/grid_field.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane.h>

#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

/** Inputs that several tests share. */
namespace pcl_mrf_planes::reference {

constexpr float NOT_MEASURED = std::numeric_limits<float>::quiet_NaN();

/** \brief A library scene by name, seen by a Kinect of any size. */
inline scenes::SceneFrame takePicture(const std::string& name, int width, int height,
                                      std::uint64_t seed,
                                      const scenes::SensorNoise& noise)
{
  scenes::View view = scenes::makeScene(name, seed);
  view.camera.resize(width, height);
  return scenes::render(view.scene, view.camera, noise, seed);
}

inline OrganizedPoints toPoints(const scenes::SceneFrame& frame)
{
  OrganizedPoints points;
  points.resize(frame.width, frame.height);
  for (std::size_t i = 0; i < frame.size(); ++i)
    points.set(i, frame.x[i], frame.y[i], frame.z[i]);
  return points;
}

inline Eigen::Vector3d randomUnit(scenes::Random& random)
{
  Eigen::Vector3d v;
  do {
    v = Eigen::Vector3d(random.normal(), random.normal(), random.normal());
  } while (v.norm() < 1e-3);
  return v.normalized();
}

/** \brief A plane up to \a farthest metres away, turned to the sensor. */
inline Plane randomPlane(scenes::Random& random, double farthest = 4.0)
{
  Plane plane;
  plane.normal = randomUnit(random);
  plane.d = random.uniform(0.1, farthest);
  plane.orientTowardsOrigin();
  return plane;
}

/** \brief An image of measured and unmeasured points with no shape at all. */
inline OrganizedPoints randomPoints(scenes::Random& random, int width, int height,
                                    double measured = 0.8)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (random.chance(measured))
      points.set(i, static_cast<float>(random.uniform(-2, 2)),
                 static_cast<float>(random.uniform(-2, 2)),
                 static_cast<float>(random.uniform(0.5, 4)));
  return points;
}

/** \brief Random costs and edges that use the whole range of 16 bits.
 * \param[in] edges share of the edges that exist */
inline GridField randomField(scenes::Random& random, int width, int height, int labels,
                             EdgeModel model, double edges = 0.9)
{
  constexpr int LARGEST_DATA = 15535; // and four prices of 12500 make 65535
  constexpr int LARGEST_PRICE = 12500;
  GridField field(width, height, labels, model);
  for (int a = 0; a < labels; ++a)
    for (int b = 0; b <= a; ++b) {
      const int low = a == b ? 0 : random.integer(0, 1) * 500;
      const int price = a == b ? 0 : random.integer(low, LARGEST_PRICE);
      field.setPairwise(a, b, static_cast<std::uint16_t>(price));
      field.setScale(a, b, static_cast<std::uint16_t>(random.integer(0, 65534)));
    }
  const auto weight = [&] {
    const int most = random.chance(0.3) ? 0 : LARGEST_PRICE;
    return static_cast<std::uint16_t>(random.chance(edges) ? random.integer(0, most)
                                                           : GridField::NO_EDGE);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      for (int l = 0; l < labels; ++l)
        field.setData(x, y, l,
                      static_cast<std::uint16_t>(random.integer(0, LARGEST_DATA)));
      if (x + 1 < width)
        field.setRightEdge(x, y, weight());
      if (y + 1 < height)
        field.setDownEdge(x, y, weight());
    }
  return field;
}

} // namespace pcl_mrf_planes::reference
