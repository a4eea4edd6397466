// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/surface_bend.h"
#include "threads.h"
#include <Eigen/Dense>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Sums over the points of a region, in a frame on its plane: everything that the quadric
/// r = x0 + x1 p + x2 q + x3 p^2 + x4 p q + x5 q^2 asks for.
class QuadricSums {
public:
  explicit QuadricSums(const FittedPlane& plane)
  : e1_(plane.normal.unitOrthogonal())
  , e2_(plane.normal.cross(e1_))
  , normal_(plane.normal)
  , centroid_(plane.centroid)
  , scale_(plane.extent > 0 ? 1 / plane.extent : 1)
  {}

  void add(double x, double y, double z)
  {
    const Eigen::Vector3d d = (Eigen::Vector3d(x, y, z) - centroid_) * scale_;
    const double p = e1_.dot(d), q = e2_.dot(d), r = normal_.dot(d);
    const double pp = p * p, pq = p * q, qq = q * q;
    const double terms[MOMENTS] = {1,       p,       q,       pp,      pq,
                                   qq,      pp * p,  pp * q,  p * qq,  qq * q,
                                   pp * pp, pp * pq, pp * qq, pq * qq, qq * qq};
    for (std::size_t k = 0; k < MOMENTS; ++k)
      moment_[k] += terms[k];
    for (std::size_t k = 0; k < UNKNOWNS; ++k)
      residual_[k] += r * terms[k];
    squared_ += r * r;
  }

  QuadricSums& operator+=(const QuadricSums& other)
  {
    for (std::size_t k = 0; k < MOMENTS; ++k)
      moment_[k] += other.moment_[k];
    for (std::size_t k = 0; k < UNKNOWNS; ++k)
      residual_[k] += other.residual_[k];
    squared_ += other.squared_;
    return *this;
  }

  Bend bend() const
  {
    constexpr double FEWEST = 12; // points: twice the unknowns
    Bend bend;
    const double n = moment_[0];
    if (n < FEWEST || squared_ <= 0)
      return bend;
    Matrix6 a = normalMatrix();
    a.diagonal().array() += 1e-9 * n;
    const Vector6 b = Eigen::Map<const Vector6>(residual_);
    const Vector6 x = a.ldlt().solve(b);
    bend.share = std::min(1.0, b.dot(x) / squared_);
    // curvature along each direction times the region's length in that direction
    Eigen::Matrix2d hessian, spread;
    hessian << 2 * x(3), x(4), x(4), 2 * x(5);
    const double p = moment_[1] / n, q = moment_[2] / n;
    spread << moment_[3] / n - p * p, moment_[4] / n - p * q, moment_[4] / n - p * q,
        moment_[5] / n - q * q;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d axis = axes.eigenvectors().col(j);
      const double length = std::sqrt(12 * std::max(0.0, axes.eigenvalues()(j)));
      bend.angle = std::max(bend.angle, std::abs(axis.dot(hessian * axis)) * length);
    }
    return bend;
  }

private:
  static constexpr std::size_t MOMENTS = 15;
  static constexpr std::size_t UNKNOWNS = 6;

  /// Which moment is the product of two of the six terms.
  Matrix6 normalMatrix() const
  {
    constexpr int PRODUCT[UNKNOWNS][UNKNOWNS] = {
        {0, 1, 2, 3, 4, 5},    {1, 3, 4, 6, 7, 8},    {2, 4, 5, 7, 8, 9},
        {3, 6, 7, 10, 11, 12}, {4, 7, 8, 11, 12, 13}, {5, 8, 9, 12, 13, 14}};
    Matrix6 a;
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        a(r, c) = moment_[PRODUCT[r][c]];
    return a;
  }

  Eigen::Vector3d e1_, e2_, normal_, centroid_;
  double scale_;
  double moment_[MOMENTS] = {};
  double residual_[UNKNOWNS] = {};
  double squared_ = 0;
};

} // namespace

std::vector<Bend> measureBends(const OrganizedPoints& points,
                               const std::vector<std::uint16_t>& labels,
                               const std::vector<FittedPlane>& planes,
                               unsigned int threads)
{
  // Of every 4th point every 4th, or of those every 4th, is enough for a large region.
  constexpr double MANY = 4000;
  constexpr double VERY_MANY = 16000;
  const auto w = static_cast<std::size_t>(points.width);
  const auto addRow = [&](std::size_t v, std::vector<QuadricSums>& sums) {
    for (std::size_t u = 0; u < w; u += 2) {
      const std::size_t i = v * w + u;
      if (labels[i] == 0)
        continue;
      const std::size_t k = labels[i] - 1U;
      const std::size_t left_out = planes[k].n < MANY        ? 0
                                   : planes[k].n < VERY_MANY ? 2
                                                             : 6; // bits of u and v
      if (((u | v) & left_out) == 0)
        sums[k].add(points.x[i], points.y[i], points.z[i]);
    }
  };
  const auto sums =
      sumOfBands((points.height + 1) / 2, threads,
                 std::vector<QuadricSums>(planes.begin(), planes.end()),
                 [&](int first, int last, std::vector<QuadricSums>& of_rows) {
                   for (int row = first; row < last; ++row)
                     addRow(2 * static_cast<std::size_t>(row), of_rows);
                 });
  std::vector<Bend> bends;
  bends.reserve(sums.size());
  for (const QuadricSums& sum : sums)
    bends.push_back(sum.bend());
  return bends;
}

} // namespace pcl_mrf_planes::adaptive
