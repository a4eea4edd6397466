// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene.h"

#include <algorithm>
#include <limits>

namespace pcl_mrf_planes::scenes {

namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

/// Whether the ray passes the box before t = limit (slab test; 1/0 gives infinities).
bool meetsBox(const Ray& ray, const Eigen::Vector3d& inverse,
              const Eigen::Vector3d& low, const Eigen::Vector3d& high, double limit)
{
  double enter = 0.0;
  double leave = limit;
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.direction[axis] == 0.0) {
      if (ray.origin[axis] < low[axis] || ray.origin[axis] > high[axis])
        return false;
      continue;
    }
    const double a = (low[axis] - ray.origin[axis]) * inverse[axis];
    const double b = (high[axis] - ray.origin[axis]) * inverse[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

} // namespace

void Scene::beginObject()
{
  const int next = static_cast<int>(surfaces_.size());
  objects_.push_back({Eigen::Vector3d::Constant(INFINITE),
                      Eigen::Vector3d::Constant(-INFINITE), next, next});
}

void Scene::add(const Shape& shape, int plane, const Colour& colour)
{
  if (objects_.empty())
    beginObject();
  surfaces_.push_back({shape, plane, colour});
  Object& object = objects_.back();
  object.last = static_cast<int>(surfaces_.size());
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITE);
  Eigen::Vector3d high = -low;
  growBox(shape, low, high);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(1e-6);
  object.low = object.low.cwiseMin(low - margin);
  object.high = object.high.cwiseMax(high + margin);
}

int Scene::addPolygon(const std::vector<Eigen::Vector3d>& corners, const Colour& colour)
{
  const Polygon polygon(corners);
  const Eigen::Vector3d normal = polygon.normal(corners[0]);
  planes_.emplace_back(normal.x(), normal.y(), normal.z(), polygon.offset());
  const int plane = static_cast<int>(planes_.size()) - 1;
  add(polygon, plane, colour);
  return plane;
}

void Scene::addPiece(int plane, const std::vector<Eigen::Vector3d>& corners,
                     const Colour& colour)
{
  add(Polygon(corners), plane, colour);
}

int Scene::addDisk(const Disk& disk, const Colour& colour)
{
  planes_.emplace_back(disk.axis.x(), disk.axis.y(), disk.axis.z(),
                       -disk.axis.dot(disk.centre));
  const int plane = static_cast<int>(planes_.size()) - 1;
  add(disk, plane, colour);
  return plane;
}

void Scene::addCurved(const Shape& shape, const Colour& colour)
{
  add(shape, -1, colour);
}

Hit Scene::cast(const Ray& ray) const
{
  const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
  Hit hit{INFINITE, -1};
  for (const Object& object : objects_) {
    if (!meetsBox(ray, inverse, object.low, object.high, hit.t))
      continue;
    for (int i = object.first; i < object.last; ++i) {
      const double t = intersect(surfaces_[static_cast<std::size_t>(i)].shape, ray);
      if (t < hit.t)
        hit = {t, i};
    }
  }
  return hit;
}

bool Scene::blocked(const Ray& ray, double limit) const
{
  const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
  for (const Object& object : objects_) {
    if (!meetsBox(ray, inverse, object.low, object.high, limit))
      continue;
    for (int i = object.first; i < object.last; ++i)
      if (intersect(surfaces_[static_cast<std::size_t>(i)].shape, ray) < limit)
        return true;
  }
  return false;
}

} // namespace pcl_mrf_planes::scenes
