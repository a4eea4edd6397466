// SPDX-License-Identifier: BSD-3-Clause
#include "planar_patches.h"
#include "plane_patch.h"

#include <pcl/kdtree/kdtree_flann.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::benchmarks::patches {

namespace {

Eigen::Vector3f normalOf(const std::vector<Eigen::Vector3f>& points,
                         const pcl::Indices& around)
{
  // About a point among them: the sums lose nothing far from the sensor.
  const Eigen::Vector3f& origin = points[static_cast<std::size_t>(around.front())];
  PlanePatch patch;
  for (const pcl::index_t k : around) {
    const Eigen::Vector3d p =
        (points[static_cast<std::size_t>(k)] - origin).cast<double>();
    patch.sums.add(p.x(), p.y(), p.z());
  }
  patch.fit();
  const Eigen::Vector3f normal = patch.normal.cast<float>();
  return normal.dot(origin) > 0.0f ? Eigen::Vector3f(-normal) : normal;
}

} // namespace

PointSet makePointSet(const Cloud& cloud, const Parameters& parameters)
{
  PointSet set;
  const Cloud::Ptr valid(new Cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (std::isfinite(cloud[i].x) && std::isfinite(cloud[i].y) &&
        std::isfinite(cloud[i].z)) {
      set.places.push_back(i);
      set.points.push_back(cloud[i].getVector3fMap());
      valid->push_back(cloud[i]);
    }
  set.count = std::min(parameters.neighbours, static_cast<int>(valid->size()));
  if (set.count < 3) {
    set = {};
    return set;
  }
  pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);
  tree.setInputCloud(valid);
  pcl::Indices around;
  std::vector<float> distances;
  for (std::size_t k = 0; k < set.size(); ++k) {
    tree.nearestKSearch((*valid)[k], set.count, around, distances);
    set.neighbours.insert(set.neighbours.end(), around.begin(), around.end());
    set.normals.push_back(normalOf(set.points, around));
  }
  return set;
}

} // namespace pcl_mrf_planes::benchmarks::patches
