// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planar_patches.h"

#include <Eigen/Core>

namespace pcl_mrf_planes::benchmarks::patches {

/** \brief The rectangle around the members of a patch on its plane, along the directions
 * of their spread. */
class PatchRectangle {
public:
  PatchRectangle(const PointSet& set, const Patch& patch);

  /** \brief Lengths of its sides, metres. */
  Eigen::Vector2f sides() const { return high_ - low_; }

  /** \brief Whether a point lies above or below it, at any distance. */
  bool covers(const Eigen::Vector3f& point) const
  {
    const Eigen::Vector2f p = onPlane(point);
    return (p.array() >= low_.array()).all() && (p.array() <= high_.array()).all();
  }

private:
  Eigen::Vector2f onPlane(const Eigen::Vector3f& point) const
  {
    return axes_ * (point - centre_);
  }

  Eigen::Vector3f centre_;
  Eigen::Matrix<float, 2, 3> axes_; // unit vectors, row by row
  Eigen::Vector2f low_, high_;
};

} // namespace pcl_mrf_planes::benchmarks::patches
