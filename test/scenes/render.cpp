// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace pcl_mrf_planes::scenes {

namespace {

std::uint8_t toByte(double share)
{
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

/// Some light from everywhere, some from a lamp, some from the camera.
double brightness(const Eigen::Vector3d& normal, const Eigen::Vector3d& view)
{
  static const Eigen::Vector3d lamp = Eigen::Vector3d(0.35, -0.5, 0.8).normalized();
  return 0.45 + 0.3 * std::abs(normal.dot(lamp)) +
         0.25 * std::abs(normal.dot(view.normalized()));
}

/// Fills the colours of the frame and returns the exact depth.
DepthImage castAll(const Scene& scene, const Camera& camera, SceneFrame& frame)
{
  DepthImage image;
  image.depth.assign(frame.size(), std::numeric_limits<double>::quiet_NaN());
  image.surface.assign(frame.size(), -1);
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const Ray ray{camera.to_world.translation(),
                    camera.to_world.linear() * camera.direction(u, v)};
      const Hit hit = scene.cast(ray);
      if (hit.surface < 0)
        continue;
      image.depth[pixel] = hit.t;
      image.surface[pixel] = hit.surface;
      const Surface& surface = scene.surfaces()[static_cast<std::size_t>(hit.surface)];
      const Eigen::Vector3d point = ray.origin + hit.t * ray.direction;
      const double light = brightness(normalAt(surface.shape, point), ray.direction);
      frame.r[pixel] = toByte(light * surface.colour[0]);
      frame.g[pixel] = toByte(light * surface.colour[1]);
      frame.b[pixel] = toByte(light * surface.colour[2]);
    }
  return image;
}

/// A plane of the world in the sensor frame, turned towards the sensor.
Eigen::Vector4d toSensor(const Eigen::Vector4d& plane, const Camera& camera)
{
  const Eigen::Vector3d normal = plane.head<3>();
  Eigen::Vector4d result;
  result.head<3>() = camera.to_world.linear().transpose() * normal;
  result[3] = plane[3] + normal.dot(camera.to_world.translation());
  result /= result.head<3>().norm();
  return result[3] < 0.0 ? Eigen::Vector4d(-result) : result;
}

void setPoints(const Camera& camera, const DepthImage& image, SceneFrame& frame)
{
  std::size_t pixel = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u, ++pixel) {
      const Eigen::Vector3d point = image.depth[pixel] * camera.direction(u, v);
      frame.x[pixel] = static_cast<float>(point.x());
      frame.y[pixel] = static_cast<float>(point.y());
      frame.z[pixel] = static_cast<float>(point.z());
    }
}

/// Numbers the planes that show, and lists them.
void setLabels(const Scene& scene, const Camera& camera, const DepthImage& image,
               SceneFrame& frame)
{
  const auto plane_of = [&](int surface) {
    return surface < 0 ? -1 : scene.surfaces()[static_cast<std::size_t>(surface)].plane;
  };
  std::vector<std::uint16_t> label(scene.planes().size(), 0);
  for (const int surface : image.surface)
    if (plane_of(surface) >= 0)
      label[static_cast<std::size_t>(plane_of(surface))] = 1;
  for (std::size_t i = 0; i < label.size(); ++i)
    if (label[i] != 0) {
      frame.planes.push_back(toSensor(scene.planes()[i], camera));
      label[i] = static_cast<std::uint16_t>(frame.planes.size());
    }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const int plane = plane_of(image.surface[i]);
    frame.labels[i] =
        plane < 0 ? std::uint16_t{0} : label[static_cast<std::size_t>(plane)];
  }
}

SceneFrame emptyFrame(const Camera& camera)
{
  const std::size_t count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  SceneFrame frame;
  frame.width = camera.width;
  frame.height = camera.height;
  frame.camera = camera;
  for (auto* plane : {&frame.x, &frame.y, &frame.z})
    plane->assign(count, std::numeric_limits<float>::quiet_NaN());
  for (auto* plane : {&frame.r, &frame.g, &frame.b})
    plane->assign(count, 0);
  frame.labels.assign(count, 0);
  return frame;
}

} // namespace

std::vector<std::size_t> SceneFrame::labelCounts() const
{
  std::vector<std::size_t> counts(planes.size() + 1, 0);
  for (const std::uint16_t label : labels)
    ++counts[label];
  return counts;
}

SceneFrame render(const Scene& scene, const Camera& camera, const SensorNoise& noise,
                  std::uint64_t seed)
{
  if (camera.width < 1 || camera.height < 1)
    throw std::invalid_argument("the image needs at least one row and one column");
  if (noise.kind == NoiseKind::KINECT && !camera.isPinhole())
    throw std::invalid_argument("Kinect noise needs a pinhole camera; choose gaussian");

  SceneFrame frame = emptyFrame(camera);
  DepthImage image = castAll(scene, camera, frame);
  Random random(seed);
  if (noise.kind == NoiseKind::GAUSSIAN)
    addGaussianNoise(camera, noise.sigma, random, image);
  else if (noise.kind == NoiseKind::KINECT)
    addKinectNoise(scene, camera, noise, random, image);
  setPoints(camera, image, frame);
  setLabels(scene, camera, image, frame);
  return frame;
}

} // namespace pcl_mrf_planes::scenes
