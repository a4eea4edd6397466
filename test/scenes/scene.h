// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/primitives.h"

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes::scenes {

using Colour = Eigen::Vector3d; ///< red, green, blue, 0 to 1

/** \brief A shape with its colour and the plane that it is a piece of. */
struct Surface {
  Shape shape;
  int plane; ///< index into Scene::planes(), -1: not a plane
  Colour colour;
};

/** \brief Where a ray ends. */
struct Hit {
  double t;    ///< ray parameter; infinity when nothing was met
  int surface; ///< index into Scene::surfaces(), -1: nothing was met
};

/** \brief Surfaces in the world frame: metres, x right, y ahead, z up.
 *
 * Surfaces added after one beginObject() share a bounding box, which makes ray casting
 * fast.
 */
class Scene {
public:
  /** \brief Start a new object; call it before the first surface as well. */
  void beginObject();

  /** \brief Add a convex polygon as a plane of its own. \return the plane's index */
  int addPolygon(const std::vector<Eigen::Vector3d>& corners, const Colour& colour);

  /** \brief Add another piece of a plane that exists: same equation, same label. */
  void addPiece(int plane, const std::vector<Eigen::Vector3d>& corners,
                const Colour& colour);

  /** \brief Add a disk as a plane of its own. \return the plane's index */
  int addDisk(const Disk& disk, const Colour& colour);

  /** \brief Add a surface that is no plane. */
  void addCurved(const Shape& shape, const Colour& colour);

  /** \brief The first surface that the ray meets. */
  Hit cast(const Ray& ray) const;

  /** \brief Whether something lies between the ray's origin and t = \a limit. */
  bool blocked(const Ray& ray, double limit) const;

  const std::vector<Surface>& surfaces() const { return surfaces_; }

  /** \brief a b c d in the world frame, (a, b, c) of unit length, any sign. */
  const std::vector<Eigen::Vector4d>& planes() const { return planes_; }

private:
  struct Object {
    Eigen::Vector3d low, high;
    int first, last; ///< surfaces [first, last)
  };

  void add(const Shape& shape, int plane, const Colour& colour);

  std::vector<Surface> surfaces_;
  std::vector<Eigen::Vector4d> planes_;
  std::vector<Object> objects_;
};

} // namespace pcl_mrf_planes::scenes
