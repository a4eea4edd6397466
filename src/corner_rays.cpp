// SPDX-License-Identifier: BSD-3-Clause
#include "corner_rays.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

constexpr int SAMPLES = 48; // a side of the image

/// Steps over pixels that give so many samples.
int sampleStep(int pixels)
{
  return std::max(1, pixels / SAMPLES);
}

} // namespace

CornerRays::CornerRays(const OrganizedPoints& points)
: points_(points)
{
  findUsualSteps();
  if (points.depth_measure != DepthMeasure::RANGE)
    fitPinhole();
}

void CornerRays::findUsualSteps()
{
  for (const int axis : {0, 1}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    const int next_x = axis == 0 ? 1 : 0;
    for (int y = 0; y < points_.height; y += sampleStep(points_.height))
      for (int x = 0; x < points_.width; x += sampleStep(points_.width))
        if (isValid(x, y) && isValid(x + next_x, y + 1 - next_x)) {
          sum += rayAt(x + next_x, y + 1 - next_x) - rayAt(x, y);
          count += 1;
        }
    usual_step_[axis] = count > 0 ? Eigen::Vector3d(sum / count) : sum;
  }
}

/// Least squares over the samples; taken if no sample is off by a hundredth of a pixel.
void CornerRays::fitPinhole()
{
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();
  const auto forSamples = [&](const auto& visit) {
    for (int y = 0; y < points_.height; y += sampleStep(points_.height))
      for (int x = 0; x < points_.width; x += sampleStep(points_.width))
        if (isValid(x, y))
          visit(Eigen::Vector3d(1.0, x, y), rayAt(x, y));
  };
  forSamples([&](const Eigen::Vector3d& pixel, const Eigen::Vector3d& ray) {
    normal += pixel * pixel.transpose();
    right += pixel * ray.transpose();
  });
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(normal);
  if (!solver.isInvertible())
    return;
  pinhole_ = solver.solve(right).transpose();
  const double least = 0.01 * std::min(pinhole_.col(1).norm(), pinhole_.col(2).norm());
  is_pinhole_ = true;
  forSamples([&](const Eigen::Vector3d& pixel, const Eigen::Vector3d& ray) {
    is_pinhole_ = is_pinhole_ && (pinhole_ * pixel - ray).norm() <= least;
  });
}

Eigen::Vector3d CornerRays::pixelRay(int pixel) const
{
  const auto i = static_cast<std::size_t>(pixel);
  const Eigen::Vector3d p(points_.x[i], points_.y[i], points_.z[i]);
  const double depth = points_.depthOf(p);
  return depth > 0.0 ? Eigen::Vector3d(p / depth) : p;
}

bool CornerRays::isValid(int x, int y) const
{
  if (x < 0 || y < 0 || x >= points_.width || y >= points_.height)
    return false;
  const int pixel = y * points_.width + x;
  return points_.valid[static_cast<std::size_t>(pixel)] != 0;
}

Eigen::Vector3d CornerRays::rayAt(int x, int y) const
{
  return pixelRay(y * points_.width + x);
}

Eigen::Vector3d CornerRays::step(int x, int y, int dx, int dy) const
{
  const bool before = isValid(x - dx, y - dy);
  const bool after = isValid(x + dx, y + dy);
  if (before && after)
    return (rayAt(x + dx, y + dy) - rayAt(x - dx, y - dy)) / 2.0;
  if (after)
    return rayAt(x + dx, y + dy) - rayAt(x, y);
  if (before)
    return rayAt(x, y) - rayAt(x - dx, y - dy);
  return usual_step_[dx == 1 ? 0 : 1];
}

Eigen::Vector3d CornerRays::cornerRay(int x, int y) const
{
  if (is_pinhole_)
    return pinhole_ * Eigen::Vector3d(1.0, x - 0.5, y - 0.5);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const int dy : {-1, 0})
    for (const int dx : {-1, 0})
      if (isValid(x + dx, y + dy)) {
        // The corner is half a step up and left of pixel (x, y), and so on.
        sum += rayAt(x + dx, y + dy) - (dx + 0.5) * step(x + dx, y + dy, 1, 0) -
               (dy + 0.5) * step(x + dx, y + dy, 0, 1);
        count += 1;
      }
  return sum / count;
}

} // namespace pcl_mrf_planes
