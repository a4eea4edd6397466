// SPDX-License-Identifier: BSD-3-Clause
#include "patch_rectangle.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace pcl_mrf_planes::benchmarks::patches {

PatchRectangle::PatchRectangle(const PointSet& set, const Patch& patch)
: centre_(patch.centre)
, low_(Eigen::Vector2f::Constant(std::numeric_limits<float>::max()))
, high_(-low_)
{
  axes_.row(0) = patch.normal.unitOrthogonal().transpose();
  axes_.row(1) = patch.normal.cross(axes_.row(0).transpose()).transpose();
  Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
  for (const int k : patch.members) {
    const Eigen::Vector2f p = onPlane(set.points[static_cast<std::size_t>(k)]);
    spread += p * p.transpose();
  }
  const float turn =
      0.5f * std::atan2(2.0f * spread(0, 1), spread(0, 0) - spread(1, 1));
  axes_ = Eigen::Rotation2Df(-turn).toRotationMatrix() * axes_;
  for (const int k : patch.members) {
    const Eigen::Vector2f p = onPlane(set.points[static_cast<std::size_t>(k)]);
    low_ = low_.cwiseMin(p);
    high_ = high_.cwiseMax(p);
  }
}

} // namespace pcl_mrf_planes::benchmarks::patches
