// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_projection.h>

#include "plane_projection_kernel.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl_mrf_planes {

namespace {

constexpr double GRAZING = 0.01745; // sine of a degree

} // namespace

Eigen::Vector3d projectPoint(const Eigen::Vector3d& point, const Plane& plane,
                             ProjectionWay way)
{
  const double facing = plane.normal.dot(point);
  const double factor = -plane.d / facing;
  if (way == ProjectionWay::RAY && std::abs(facing) > GRAZING * point.norm() &&
      factor > 0.0)
    return factor * point;
  return point - plane.distance(point) * plane.normal;
}

void projectOntoPlanes(const std::vector<PlaneRegion>& regions, ProjectionWay way,
                       OrganizedPoints& points)
{
  for (const PlaneRegion& region : regions)
    for (const int index : region.indices) {
      const auto i = static_cast<std::size_t>(index);
      const Eigen::Vector3d p =
          projectPoint({points.x[i], points.y[i], points.z[i]}, region.plane, way);
      points.set(i, static_cast<float>(p.x()), static_cast<float>(p.y()),
                 static_cast<float>(p.z()));
    }
}

void projectPoints(const Plane& plane, const Eigen::Vector3d& origin, ProjectionWay way,
                   const std::vector<int>& indices, std::size_t stride, float* first)
{
  const Eigen::Vector3d& n = plane.normal;
  const ProjectionTarget target = {
      {n.x(), n.y(), n.z()},
      plane.d,
      {origin.x(), origin.y(), origin.z()},
      way == ProjectionWay::RAY ? GRAZING : std::numeric_limits<double>::infinity()};
  projectPoints(target, indices.data(), indices.size(), stride, first);
}

std::vector<int> pointsOfNoPlane(const OrganizedPoints& points,
                                 const std::vector<std::uint16_t>& labels, bool invalid)
{
  std::vector<int> rest;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] == 0 && (invalid || points.valid[i] != 0))
      rest.push_back(static_cast<int>(i));
  return rest;
}

} // namespace pcl_mrf_planes
