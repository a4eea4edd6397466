// SPDX-License-Identifier: BSD-3-Clause
#include "pick_point.h"

#include <limits>

namespace pcl_mrf_planes::viewer {

long pickPoint(const pcl::PointCloud<pcl::PointXYZ>& cloud,
               const std::vector<bool>& shown, const Eigen::Matrix4d& projection,
               const Eigen::Vector2d& place, const Eigen::Vector2d& reach)
{
  long best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!shown[i])
      continue;
    const Eigen::Vector4d p =
        projection * cloud[i].getVector3fMap().cast<double>().homogeneous();
    if (p.w() <= 0.0 || p.z() / p.w() >= nearest) // behind the viewer, or hidden
      continue;
    const Eigen::Vector2d off = p.head<2>() / p.w() - place;
    if (std::abs(off.x()) > reach.x() || std::abs(off.y()) > reach.y())
      continue;
    nearest = p.z() / p.w();
    best = static_cast<long>(i);
  }
  return best;
}

} // namespace pcl_mrf_planes::viewer
