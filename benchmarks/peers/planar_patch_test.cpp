// SPDX-License-Identifier: BSD-3-Clause
#include "patch_rectangle.h"
#include "planar_patches.h"
#include "robust_statistics.h"

#include <algorithm>
#include <cmath>

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
  return PatchRectangle(set, *this).sides().minCoeff();
}

} // namespace pcl_mrf_planes::benchmarks::patches
