// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/primitives.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace pcl_mrf_planes::scenes {

namespace {

constexpr double MISS = std::numeric_limits<double>::infinity();

/// Nearer hits are the surface that the ray starts from. Metres, for unit directions.
constexpr double NEAREST = 1e-6;

/// Pieces overlap by this much, metres, so that no ray slips through a seam.
constexpr double SEAM = 1e-9;

/// Where the ray meets the plane n . p + offset = 0.
double intersectPlane(const Eigen::Vector3d& n, double offset, const Ray& ray)
{
  const double slope = n.dot(ray.direction);
  if (slope == 0.0)
    return MISS;
  const double t = -(n.dot(ray.origin) + offset) / slope;
  return t > NEAREST ? t : MISS;
}

/// Roots of a t^2 + 2 b t + c, the smaller first; false when there are none.
bool solveQuadratic(double a, double b, double c, double& first, double& second)
{
  const double discriminant = b * b - a * c;
  if (a <= 0.0 || discriminant < 0.0)
    return false;
  const double root = std::sqrt(discriminant);
  first = (-b - root) / a;
  second = (-b + root) / a;
  return true;
}

void grow(const Eigen::Vector3d& point, Eigen::Vector3d& low, Eigen::Vector3d& high)
{
  low = low.cwiseMin(point);
  high = high.cwiseMax(point);
}

void grow(const Eigen::Vector3d& centre, double radius, Eigen::Vector3d& low,
          Eigen::Vector3d& high)
{
  grow(centre - Eigen::Vector3d::Constant(radius), low, high);
  grow(centre + Eigen::Vector3d::Constant(radius), low, high);
}

} // namespace

Polygon::Polygon(const std::vector<Eigen::Vector3d>& corners)
: corners_(corners)
{
  normal_ = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  offset_ = -normal_.dot(corners[0]);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d side = corners[(i + 1) % corners.size()] - corners[i];
    const Eigen::Vector3d inward = normal_.cross(side).normalized();
    edges_.push_back({inward, inward.dot(corners[i]) - SEAM});
  }
}

double Polygon::intersect(const Ray& ray) const
{
  const double t = intersectPlane(normal_, offset_, ray);
  if (t == MISS)
    return MISS;
  const Eigen::Vector3d p = ray.origin + t * ray.direction;
  for (const Edge& edge : edges_)
    if (edge.inward.dot(p) < edge.offset)
      return MISS;
  return t;
}

void Polygon::growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const
{
  for (const Eigen::Vector3d& corner : corners_)
    grow(corner, low, high);
}

double Disk::intersect(const Ray& ray) const
{
  const double t = intersectPlane(axis, -axis.dot(centre), ray);
  if (t == MISS)
    return MISS;
  const Eigen::Vector3d p = ray.origin + t * ray.direction;
  return (p - centre).squaredNorm() <= radius * radius ? t : MISS;
}

void Disk::growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const
{
  grow(centre, radius, low, high);
}

double Sphere::intersect(const Ray& ray) const
{
  const Eigen::Vector3d o = ray.origin - centre;
  double first = 0.0;
  double second = 0.0;
  if (!solveQuadratic(ray.direction.squaredNorm(), o.dot(ray.direction),
                      o.squaredNorm() - radius * radius, first, second))
    return MISS;
  if (first > NEAREST)
    return first;
  return second > NEAREST ? second : MISS;
}

void Sphere::growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const
{
  grow(centre, radius, low, high);
}

double Cylinder::intersect(const Ray& ray) const
{
  const Eigen::Vector3d o = ray.origin - base;
  const double o_along = o.dot(axis);
  const double d_along = ray.direction.dot(axis);
  const Eigen::Vector3d o_across = o - o_along * axis;
  const Eigen::Vector3d d_across = ray.direction - d_along * axis;
  double roots[2];
  if (!solveQuadratic(d_across.squaredNorm(), o_across.dot(d_across),
                      o_across.squaredNorm() - radius * radius, roots[0], roots[1]))
    return MISS;
  for (const double t : roots) {
    const double along = o_along + t * d_along;
    if (t > NEAREST && along >= -SEAM && along <= length + SEAM)
      return t;
  }
  return MISS;
}

Eigen::Vector3d Cylinder::normal(const Eigen::Vector3d& p) const
{
  const Eigen::Vector3d o = p - base;
  return (o - o.dot(axis) * axis) / radius;
}

void Cylinder::growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const
{
  grow(base, radius, low, high);
  grow(base + length * axis, radius, low, high);
}

double intersect(const Shape& shape, const Ray& ray)
{
  return std::visit([&](const auto& s) { return s.intersect(ray); }, shape);
}

Eigen::Vector3d normalAt(const Shape& shape, const Eigen::Vector3d& point)
{
  return std::visit([&](const auto& s) -> Eigen::Vector3d { return s.normal(point); },
                    shape);
}

void growBox(const Shape& shape, Eigen::Vector3d& low, Eigen::Vector3d& high)
{
  std::visit([&](const auto& s) { s.growBox(low, high); }, shape);
}

} // namespace pcl_mrf_planes::scenes
