// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <variant>
#include <vector>

namespace pcl_mrf_planes::scenes {

/** \brief Half line origin + t direction, t > 0. The direction need not be a unit. */
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/** \brief Convex piece of a plane, seen from both sides. */
class Polygon {
public:
  /** \brief From three or more corners in order, metres, all in one plane. */
  explicit Polygon(const std::vector<Eigen::Vector3d>& corners);

  double intersect(const Ray& ray) const;
  Eigen::Vector3d normal(const Eigen::Vector3d&) const { return normal_; }
  void growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const;

  /** \brief n . p + offset = 0 on the plane, n of unit length. */
  double offset() const { return offset_; }

private:
  struct Edge {
    Eigen::Vector3d inward; ///< unit, in the plane
    double offset;          ///< inward . p >= offset inside
  };
  std::vector<Eigen::Vector3d> corners_;
  Eigen::Vector3d normal_;
  double offset_;
  std::vector<Edge> edges_;
};

/** \brief Round piece of a plane: the lid of a cylinder. */
struct Disk {
  Eigen::Vector3d centre; ///< metres
  Eigen::Vector3d axis;   ///< unit normal
  double radius;          ///< metres, > 0

  double intersect(const Ray& ray) const;
  Eigen::Vector3d normal(const Eigen::Vector3d&) const { return axis; }
  void growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const;
};

struct Sphere {
  Eigen::Vector3d centre; ///< metres
  double radius;          ///< metres, > 0

  double intersect(const Ray& ray) const;
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const
  {
    return (p - centre) / radius;
  }
  void growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const;
};

/** \brief Curved side of a cylinder, without lids. */
struct Cylinder {
  Eigen::Vector3d base; ///< centre of the lower rim, metres
  Eigen::Vector3d axis; ///< unit, from the base along the length
  double length;        ///< metres, > 0
  double radius;        ///< metres, > 0

  double intersect(const Ray& ray) const;
  Eigen::Vector3d normal(const Eigen::Vector3d& p) const;
  void growBox(Eigen::Vector3d& low, Eigen::Vector3d& high) const;
};

using Shape = std::variant<Polygon, Disk, Sphere, Cylinder>;

/** \brief Smallest t > 0 at which the ray meets the shape; infinity when it does not.
 */
double intersect(const Shape& shape, const Ray& ray);

/** \brief Unit normal at a point of the shape; its sign means nothing. */
Eigen::Vector3d normalAt(const Shape& shape, const Eigen::Vector3d& point);

/** \brief Enlarge the box from \a low to \a high until it holds the shape. */
void growBox(const Shape& shape, Eigen::Vector3d& low, Eigen::Vector3d& high);

} // namespace pcl_mrf_planes::scenes
