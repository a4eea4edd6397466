// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_mrf_planes::scenes {

namespace {

// The sensor itself, whatever the size of the picture: see addKinectNoise().
constexpr double FOCAL = 575.0;    // pixels
constexpr double BASELINE = 0.075; // metres; the projector is at the camera's right
constexpr double LEVELS = 8.0;     // disparity levels per pixel
// Khoshelham: half a level in all. Rounding alone gives 1/sqrt(12), the rest is noise.
constexpr double TOTAL_NOISE = 0.5; // levels
const double RANDOM_NOISE = std::sqrt(TOTAL_NOISE * TOTAL_NOISE - 1.0 / 12.0);

/// Normal numbers of deviation 1, smoothed over 3x3 pixels with weights 1 2 1.
std::vector<double> smoothNoise(int width, int height, Random& random)
{
  const std::size_t w = static_cast<std::size_t>(width);
  const std::size_t h = static_cast<std::size_t>(height);
  const std::size_t padded = w + 2;
  std::vector<double> rough(padded * (h + 2));
  for (double& value : rough)
    value = random.normal();

  // Weights 1/4 1/2 1/4 shrink the variance to 3/8 on each axis.
  constexpr double GAIN = 1.0 / 0.375;
  std::vector<double> smooth(w * h);
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x) {
      double sum = 0.0;
      for (std::size_t row = 0; row < 3; ++row) {
        const double* r = &rough[(y + row) * padded + x];
        sum += (row == 1 ? 0.5 : 0.25) * (0.25 * r[0] + 0.5 * r[1] + 0.25 * r[2]);
      }
      smooth[y * w + x] = GAIN * sum;
    }
  return smooth;
}

/// Whether another surface shows within two pixels.
bool nearEdge(const DepthImage& image, int width, int height, int x, int y)
{
  const auto at = [&](int u, int v) {
    return image.surface[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(u)];
  };
  const int here = at(x, y);
  for (int v = std::max(0, y - 2); v <= std::min(height - 1, y + 2); ++v)
    for (int u = std::max(0, x - 2); u <= std::min(width - 1, x + 2); ++u)
      if (at(u, v) != here)
        return true;
  return false;
}

Ray worldRay(const Camera& camera, double u, double v)
{
  return {camera.to_world.translation(),
          camera.to_world.linear() * camera.direction(u, v)};
}

/// Pixels at edges take the depth of the place beside them that a shaky ray meets.
void jitterEdges(const Scene& scene, const Camera& camera, double sigma, Random& random,
                 DepthImage& image)
{
  const std::vector<double> dx = smoothNoise(camera.width, camera.height, random);
  const std::vector<double> dy = smoothNoise(camera.width, camera.height, random);
  const DepthImage exact = image;
  std::size_t pixel = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x, ++pixel) {
      if (!nearEdge(exact, camera.width, camera.height, x, y))
        continue;
      const Hit hit =
          scene.cast(worldRay(camera, x + sigma * dx[pixel], y + sigma * dy[pixel]));
      if (hit.surface == exact.surface[pixel])
        continue; // inside one surface a shaky ray changes nothing worth having
      if (hit.surface < 0)
        image.invalidate(pixel);
      else {
        image.depth[pixel] = hit.t;
        image.surface[pixel] = hit.surface;
      }
    }
}

/// Points that the projector's light does not reach have no depth.
void castShadows(const Scene& scene, const Camera& camera, DepthImage& image)
{
  const Eigen::Vector3d projector = camera.to_world * Eigen::Vector3d(BASELINE, 0, 0);
  std::size_t pixel = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x, ++pixel) {
      if (image.surface[pixel] < 0)
        continue;
      const Eigen::Vector3d point =
          camera.to_world * (image.depth[pixel] * camera.direction(x, y));
      // Points moved by the jitter lie up to a pixel off their surface: leave a margin.
      if (scene.blocked({projector, point - projector}, 0.99))
        image.invalidate(pixel);
    }
}

void limitRange(const SensorNoise& noise, DepthImage& image)
{
  for (std::size_t i = 0; i < image.depth.size(); ++i)
    if (!(image.depth[i] >= noise.min_depth && image.depth[i] <= noise.max_depth))
      image.invalidate(i);
}

void disturbDisparity(const Camera& camera, double scale, Random& random,
                      DepthImage& image)
{
  const std::vector<double> field = smoothNoise(camera.width, camera.height, random);
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.surface[i] < 0)
      continue;
    const double exact = LEVELS * FOCAL * BASELINE / image.depth[i];
    const double level = std::floor(exact + scale * RANDOM_NOISE * field[i] + 0.5);
    if (level < 1.0)
      image.invalidate(i);
    else
      image.depth[i] = LEVELS * FOCAL * BASELINE / level;
  }
}

} // namespace

void DepthImage::invalidate(std::size_t pixel)
{
  depth[pixel] = std::numeric_limits<double>::quiet_NaN();
  surface[pixel] = -1;
}

SensorNoise SensorNoise::gaussian(double sigma)
{
  SensorNoise noise;
  noise.kind = NoiseKind::GAUSSIAN;
  noise.sigma = sigma;
  return noise;
}

SensorNoise SensorNoise::kinect(double scale)
{
  SensorNoise noise;
  noise.kind = NoiseKind::KINECT;
  noise.scale = scale;
  return noise;
}

void addGaussianNoise(const Camera& camera, double sigma, Random& random,
                      DepthImage& image)
{
  std::size_t pixel = 0;
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x, ++pixel) {
      const double error = sigma * random.normal(); // drawn for holes as well
      if (image.surface[pixel] < 0)
        continue;
      image.depth[pixel] += error / camera.direction(x, y).norm();
      if (image.depth[pixel] <= 0.0)
        image.invalidate(pixel);
    }
}

void addKinectNoise(const Scene& scene, const Camera& camera, const SensorNoise& noise,
                    Random& random, DepthImage& image)
{
  if (noise.jitter > 0.0)
    jitterEdges(scene, camera, noise.jitter, random, image);
  if (noise.shadows)
    castShadows(scene, camera, image);
  limitRange(noise, image);
  disturbDisparity(camera, noise.scale, random, image);
}

} // namespace pcl_mrf_planes::scenes
