// SPDX-License-Identifier: BSD-3-Clause
#include "planar_patches.h"
#include "robust_statistics.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_mrf_planes::benchmarks::patches {

namespace {

constexpr double RADIANS = M_PI / 180.0; // a degree in radians

/// The median of each coordinate.
Eigen::Vector3f medians(const std::vector<Eigen::Vector3f>& vectors,
                        const std::vector<int>& members)
{
  Eigen::Vector3f result;
  std::vector<float> values(members.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(members.begin(), members.end(), values.begin(),
                   [&](int k) { return vectors[static_cast<std::size_t>(k)][axis]; });
    result[axis] = medianOf(values);
  }
  return result;
}

/// Sides of the rectangle around points, along the directions of their spread.
Eigen::Vector2f sidesOf(const PointSet& set, const Patch& patch)
{
  const Eigen::Vector3f u = patch.normal.unitOrthogonal();
  const Eigen::Vector3f v = patch.normal.cross(u);
  Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
  const auto onPlane = [&](int k) {
    const Eigen::Vector3f p = set.points[static_cast<std::size_t>(k)] - patch.centre;
    return Eigen::Vector2f(u.dot(p), v.dot(p));
  };
  for (const int k : patch.members)
    spread += onPlane(k) * onPlane(k).transpose();
  const float turn =
      0.5f * std::atan2(2.0f * spread(0, 1), spread(0, 0) - spread(1, 1));
  const Eigen::Rotation2Df rotation(-turn);
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f high = -low;
  for (const int k : patch.members) {
    const Eigen::Vector2f p = rotation * onPlane(k);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return high - low;
}

} // namespace

void Patch::fit(const PointSet& set)
{
  centre = medians(set.points, members);
  normal = medians(set.normals, members);
  const float length = normal.norm();
  normal = length > 0.0f ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
  std::vector<float> distances, cosines;
  for (const int k : members) {
    distances.push_back(distance(set.points[static_cast<std::size_t>(k)]));
    cosines.push_back(cosine(set.normals[static_cast<std::size_t>(k)]));
  }
  most_distance = robustRange(std::move(distances)).high;
  least_cosine = robustRange(std::move(cosines)).low;
  fitted = members.size();
}

bool Patch::passTest(const PointSet& set, const Parameters& parameters)
{
  if (least_cosine < std::cos(RADIANS * parameters.normal_variance))
    return false;
  // The diagonal from one edge to the other, through the thickness of the patch.
  const float side = shorterSide(set);
  if (std::atan2(side, most_distance) < RADIANS * parameters.coplanarity)
    return false;
  const auto first_outlier = std::stable_partition(
      members.begin(), members.end(), [&](int k) { return isInlier(set, k); });
  const auto outliers = static_cast<double>(members.end() - first_outlier);
  if (outliers > parameters.outlier_ratio * static_cast<double>(members.size()))
    return false;
  members.erase(first_outlier, members.end());
  return !members.empty();
}

float Patch::shorterSide(const PointSet& set) const
{
  return sidesOf(set, *this).minCoeff();
}

} // namespace pcl_mrf_planes::benchmarks::patches
