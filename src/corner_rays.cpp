// SPDX-License-Identifier: BSD-3-Clause
#include "corner_rays.h"

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

CornerRays::CornerRays(const OrganizedPoints& points)
: points_(points)
{
  constexpr int SAMPLES = 64; // a side
  const int dx = std::max(1, points.width / SAMPLES);
  const int dy = std::max(1, points.height / SAMPLES);
  for (const int axis : {0, 1}) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double count = 0;
    const int next_x = axis == 0 ? 1 : 0;
    for (int y = 0; y < points.height; y += dy)
      for (int x = 0; x < points.width; x += dx)
        if (isValid(x, y) && isValid(x + next_x, y + 1 - next_x)) {
          sum += rayAt(x + next_x, y + 1 - next_x) - rayAt(x, y);
          count += 1;
        }
    usual_step_[axis] = count > 0 ? Eigen::Vector3d(sum / count) : sum;
  }
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
  return x >= 0 && y >= 0 && x < points_.width && y < points_.height &&
         points_.valid[static_cast<std::size_t>(y * points_.width + x)] != 0;
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
