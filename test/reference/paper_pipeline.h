// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/energy.h"
#include "reference/merging.h"
#include "reference/plane_fit.h"
#include "reference/propagation.h"

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::reference {

/** \brief The energy of PaperEnergy in whole units, as fine as 16 bits allow.
 *
 * Every term is rounded by itself: data terms and depth steps in single precision, as
 * the points are; dissimilarities in double. A price is what a pair of
 * labels costs beyond the depth step that every pair pays. For HYBRID. */
class WholeUnitEnergy {
public:
  using Cost = std::int64_t;

  WholeUnitEnergy(const OrganizedPoints& points, std::vector<Eigen::Vector4d> planes,
                  const Parameters& parameters)
  : exact_(points, planes, parameters)
  , points_(points)
  , labels_(static_cast<int>(planes.size()))
  {
    double most = 0.0;
    for (int a = 0; a < labels_; ++a)
      for (int b = 0; b < labels_; ++b)
        most = std::max(most, exact_.smoothness(a, b, 0.0));
    // A data cost and four messages, each rounded up at worst, stay below 2^16.
    units_ = (65535.0 - 5.0) / (parameters.lambda * parameters.tau + 4.0 * most);
    for (int a = 0; a < labels_; ++a)
      for (int b = 0; b < labels_; ++b)
        eps_.push_back(std::lround(exact_.smoothness(a, b, 0.0) * units_));
    const auto scale = static_cast<float>(parameters.lambda * units_);
    const auto tau = static_cast<float>(parameters.tau);
    for (std::size_t i = 0; i < points.size(); ++i)
      for (const Eigen::Vector4d& plane : planes) {
        const Eigen::Vector4f p = plane.cast<float>();
        const float r =
            (p[0] * points.x[i] + p[1] * points.y[i]) + (p[2] * points.z[i] + p[3]);
        const float cost = std::nearbyint(std::min(std::abs(r), tau) * scale);
        data_.push_back(points.valid[i] != 0 ? static_cast<std::int32_t>(cost) : 0);
      }
  }

  int width() const { return exact_.width(); }
  int height() const { return exact_.height(); }
  int labels() const { return labels_; }
  double unitsPerEnergy() const { return units_; }

  Cost data(int x, int y, int l) const
  {
    return data_[at(x, y) * static_cast<std::size_t>(labels_) +
                 static_cast<std::size_t>(l)];
  }
  bool connected(int x, int y, int u, int v) const
  {
    return exact_.connected(x, y, u, v);
  }
  Cost price(int x, int y, int u, int v, int a, int b) const
  {
    const float step = std::abs(points_.depth(at(x, y)) - points_.depth(at(u, v)));
    const auto dz = static_cast<Cost>(
        std::nearbyint(std::min(step * static_cast<float>(units_), 65534.0f)));
    const std::size_t pair =
        static_cast<std::size_t>(a) * static_cast<std::size_t>(labels_) +
        static_cast<std::size_t>(b);
    return std::max<Cost>(0, eps_[pair] - dz);
  }

private:
  std::size_t at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x);
  }

  PaperEnergy exact_;
  const OrganizedPoints& points_;
  int labels_;
  double units_ = 1.0;
  std::vector<Cost> eps_;
  std::vector<std::int32_t> data_;
};

/** \brief What the reference finds. */
struct PaperResult {
  std::vector<MergedPlane> planes;
  std::size_t kept_tiles = 0;
  Labels labels; ///< index into planes for every point; of no meaning where invalid
};

/** \brief The planes of section IV-A and IV-B: tiles, fits, merging. */
inline PaperResult paperPlanes(const OrganizedPoints& points,
                               const Parameters& parameters)
{
  std::vector<MergedPlane> tiles;
  for (int top = 0; top < points.height; top += parameters.tile_height)
    for (int left = 0; left < points.width; left += parameters.tile_width) {
      Points measured;
      int area = 0;
      for (int y = top; y < std::min(points.height, top + parameters.tile_height); ++y)
        for (int x = left; x < std::min(points.width, left + parameters.tile_width);
             ++x) {
          ++area;
          const std::size_t i =
              static_cast<std::size_t>(y) * static_cast<std::size_t>(points.width) +
              static_cast<std::size_t>(x);
          if (points.valid[i] != 0)
            measured.emplace_back(points.x[i], points.y[i], points.z[i]);
        }
      const auto count = static_cast<double>(measured.size());
      if (measured.size() < 3 || count < parameters.min_valid_share * area)
        continue;
      // One row or column of pixels: a plane through the sensor, not a surface.
      if (points.width - left == 1 || points.height - top == 1)
        continue;
      const Fit fit = parameters.fit == PlaneFit::ALGEBRAIC ? fitAlgebraic(measured)
                                                            : fitGeometric(measured);
      if (!fit.valid)
        continue;
      const Eigen::Vector3d middle = mean(measured);
      const double depth = points.depth_measure == DepthMeasure::RANGE
                               ? middle.norm()
                               : std::abs(middle.z());
      if (fit.rms > parameters.noise_multiplier * parameters.noise.sigma(depth))
        continue;
      tiles.push_back({fit.plane, fit.rms, count, {tiles.size()}});
    }
  PaperResult result;
  result.kept_tiles = tiles.size();
  result.planes = mergePlanes(tiles, parameters.beta, parameters.merge_threshold);
  if (result.planes.size() > static_cast<std::size_t>(parameters.max_planes))
    result.planes.resize(static_cast<std::size_t>(parameters.max_planes));
  return result;
}

/** \brief Section IV, points to labels; Energy is WholeUnitEnergy or PaperEnergy. */
template <typename Energy>
PaperResult segmentAsPaper(const OrganizedPoints& points, const Parameters& parameters)
{
  PaperResult result = paperPlanes(points, parameters);
  if (result.planes.empty())
    return result;
  std::vector<Eigen::Vector4d> planes;
  for (const MergedPlane& plane : result.planes)
    planes.push_back(plane.plane);
  const Energy energy(points, planes, parameters);
  Propagation<Energy> propagation(energy);
  propagation.iterate(parameters.iterations);
  result.labels = propagation.mapLabels();
  return result;
}

} // namespace pcl_mrf_planes::reference
