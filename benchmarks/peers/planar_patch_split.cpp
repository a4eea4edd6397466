// SPDX-License-Identifier: BSD-3-Clause
#include "planar_patches.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::benchmarks::patches {

namespace {

/// Nodes of an octree, tested from the leaves up: a node whose parts hold a patch is
/// not tested itself.
class Octree {
public:
  Octree(const PointSet& set, const Parameters& parameters)
  : set_(set)
  , parameters_(parameters)
  , min_points_(static_cast<std::size_t>(std::max<double>(
        parameters.min_points, parameters.min_share * static_cast<double>(set.size()))))
  {}

  std::vector<Patch> patches()
  {
    Eigen::Vector3f low = set_.points.front(), high = low;
    for (const Eigen::Vector3f& point : set_.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    std::vector<int> all(set_.size());
    std::iota(all.begin(), all.end(), 0);
    detect(std::move(all), (low + high) / 2.0f, (high - low).maxCoeff() / 2.0f, 0);
    return std::move(patches_);
  }

private:
  static constexpr int FIRST_LEVEL = 3; // larger nodes are not tested
  static constexpr int LAST_LEVEL = 20; // where points coincide

  /// \return whether a patch was found in the node or in its parts
  bool detect(std::vector<int> points, const Eigen::Vector3f& centre, float half,
              int level)
  {
    if (points.size() < min_points_)
      return false;
    bool found = false;
    if (level < LAST_LEVEL)
      for (int octant = 0; octant < 8; ++octant) {
        const Eigen::Vector3f towards((octant & 1) != 0 ? 1.0f : -1.0f,
                                      (octant & 2) != 0 ? 1.0f : -1.0f,
                                      (octant & 4) != 0 ? 1.0f : -1.0f);
        found |= detect(pointsIn(points, centre, octant),
                        centre + towards * half / 2.0f, half / 2.0f, level + 1);
      }
    if (found || level < FIRST_LEVEL)
      return found;
    Patch patch;
    patch.members = std::move(points);
    patch.fit(set_);
    if (!patch.passTest(set_, parameters_))
      return false;
    patches_.push_back(std::move(patch));
    return true;
  }

  std::vector<int> pointsIn(const std::vector<int>& points,
                            const Eigen::Vector3f& centre, int octant) const
  {
    std::vector<int> inside;
    for (const int k : points) {
      const Eigen::Vector3f& p = set_.points[static_cast<std::size_t>(k)];
      if ((p.x() > centre.x()) + 2 * (p.y() > centre.y()) + 4 * (p.z() > centre.z()) ==
          octant)
        inside.push_back(k);
    }
    return inside;
  }

  const PointSet& set_;
  const Parameters& parameters_;
  std::size_t min_points_;
  std::vector<Patch> patches_;
};

} // namespace

std::vector<Patch> split(const PointSet& set, const Parameters& parameters)
{
  if (set.size() == 0)
    return {};
  return Octree(set, parameters).patches();
}

} // namespace pcl_mrf_planes::benchmarks::patches
