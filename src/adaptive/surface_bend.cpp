// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/surface_bend.h"
#include "frame_memory.h"
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

/// Of every 4th point every 4th, or of those every 4th, is enough for a large region.
std::size_t stepOf(const FittedPlane& plane)
{
  constexpr double MANY = 4000;
  constexpr double VERY_MANY = 16000;
  return plane.n < MANY ? 2 : plane.n < VERY_MANY ? 4 : 8;
}

} // namespace

FrameVector<Bend> measureBends(const OrganizedPoints& points, const LabelRuns& image,
                               const FrameVector<FittedPlane>& planes,
                               unsigned int threads)
{
  const auto addRun = [&](const LabelRun& run, std::size_t row, QuadricSums& sums) {
    const std::size_t step = stepOf(planes[run.label - 1U]);
    if (row % step != 0)
      return;
    const std::size_t begin = row * image.width;
    for (std::size_t u = (run.begin - begin + step - 1) / step * step;
         begin + u < run.end; u += step)
      sums.add(points.x[begin + u], points.y[begin + u], points.z[begin + u]);
  };
  const auto sums =
      sumOfBands((points.height + 1) / 2, threads,
                 FrameVector<QuadricSums>(planes.begin(), planes.end()),
                 [&](int first, int last, FrameVector<QuadricSums>& of_rows) {
                   for (int pair = first; pair < last; ++pair) {
                     const std::size_t row = 2 * static_cast<std::size_t>(pair);
                     for (std::size_t k = image.rows[row]; k < image.rows[row + 1]; ++k)
                       if (const LabelRun& run = image.runs[k]; run.label != 0)
                         addRun(run, row, of_rows[run.label - 1U]);
                   }
                 });
  FrameVector<Bend> bends(sums.size());
  parallelRows(static_cast<int>(sums.size()), threads, [&](int k) {
    bends[static_cast<std::size_t>(k)] = sums[static_cast<std::size_t>(k)].bend();
  });
  return bends;
}

} // namespace pcl_mrf_planes::adaptive
