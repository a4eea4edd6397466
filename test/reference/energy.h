// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/merging.h"

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::reference {

/** \brief The energy of section IV-C in double precision, nothing rounded.
 *
 * A problem for propagation.h: width(), height(), labels(), data(), connected() and
 * price(). */
class PaperEnergy {
public:
  using Cost = double;

  PaperEnergy(const OrganizedPoints& points, std::vector<Eigen::Vector4d> planes,
              const Parameters& parameters)
  : points_(points)
  , planes_(std::move(planes))
  , parameters_(parameters)
  {}

  int width() const { return points_.width; }
  int height() const { return points_.height; }
  int labels() const { return static_cast<int>(planes_.size()); }

  /** \brief Equation (7); nothing for a point that was not measured. */
  double data(int x, int y, int l) const
  {
    const std::size_t i = at(x, y);
    if (points_.valid[i] == 0)
      return 0.0;
    const Eigen::Vector4d& p = planes_[static_cast<std::size_t>(l)];
    const double r = std::abs(p[0] * points_.x[i] + p[1] * points_.y[i] +
                              p[2] * points_.z[i] + p[3]);
    return parameters_.lambda * std::min(r, parameters_.tau);
  }

  /** \brief True for 4-neighbours that were both measured. */
  bool connected(int x, int y, int u, int v) const
  {
    return u >= 0 && v >= 0 && u < width() && v < height() &&
           std::abs(x - u) + std::abs(y - v) == 1 && points_.valid[at(x, y)] != 0 &&
           points_.valid[at(u, v)] != 0;
  }

  /** \brief Smoothness term of two neighbours with labels a and b. */
  double price(int x, int y, int u, int v, int a, int b) const
  {
    return smoothness(a, b, depth(x, y) - depth(u, v));
  }

  /** \brief (8), (9), (10) or the variant in the text before (10). */
  double smoothness(int a, int b, double dz) const
  {
    const Eigen::Vector4d& p = planes_[static_cast<std::size_t>(a)];
    const Eigen::Vector4d& q = planes_[static_cast<std::size_t>(b)];
    const double eps = a == b ? 0.0 : dissimilarity(p, q, parameters_.beta);
    switch (parameters_.smoothness) {
    case Smoothness::POTTS:
      return a == b ? 0.0 : parameters_.gamma;
    case Smoothness::DISSIMILARITY:
      return eps;
    case Smoothness::HYBRID:
      return std::max(std::abs(dz), eps);
    case Smoothness::PREDICTED_DEPTH:
      break;
    }
    // One plane predicts |(1 - c) dz|; between two planes the mean of both.
    const double predicted =
        (std::abs((1.0 - p[2]) * dz) + std::abs((1.0 - q[2]) * dz)) / 2.0;
    return std::max(predicted, eps);
  }

  double depth(int x, int y) const
  {
    const std::size_t i = at(x, y);
    if (points_.depth_measure == DepthMeasure::RANGE)
      return Eigen::Vector3d(points_.x[i], points_.y[i], points_.z[i]).norm();
    return points_.z[i];
  }

private:
  std::size_t at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x);
  }

  const OrganizedPoints& points_;
  std::vector<Eigen::Vector4d> planes_;
  Parameters parameters_;
};

inline std::vector<Eigen::Vector4d> toVectors(const std::vector<Plane>& planes)
{
  std::vector<Eigen::Vector4d> vectors;
  for (const Plane& plane : planes)
    vectors.emplace_back(plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.d);
  return vectors;
}

} // namespace pcl_mrf_planes::reference
