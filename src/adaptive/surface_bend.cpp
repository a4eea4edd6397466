// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/surface_bend.h"
#include <Eigen/Dense>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Frame {
  Eigen::Vector3d e1, e2;
  double scale = 1;
  Matrix6 a = Matrix6::Zero();
  Vector6 b = Vector6::Zero();
  double rr = 0, n = 0;
};

} // namespace

std::vector<Bend> measureBends(const OrganizedPoints& points,
                               const std::vector<std::uint16_t>& labels,
                               const std::vector<FittedPlane>& planes)
{
  std::vector<Frame> frames(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    Frame& f = frames[k];
    f.e1 = planes[k].normal.unitOrthogonal();
    f.e2 = planes[k].normal.cross(f.e1);
    f.scale = planes[k].extent > 0 ? 1 / planes[k].extent : 1;
  }
  const auto w = static_cast<std::size_t>(points.width);
  const auto h = static_cast<std::size_t>(points.height);
  for (std::size_t v = 0; v < h; v += 2)
    for (std::size_t u = 0; u < w; u += 2) {
      const std::size_t i = v * w + u;
      if (!labels[i])
        continue;
      const std::size_t k = labels[i] - 1u;
      Frame& f = frames[k];
      const Eigen::Vector3d d =
          (Eigen::Vector3d(points.x[i], points.y[i], points.z[i]) -
           planes[k].centroid) *
          f.scale;
      const double p = f.e1.dot(d), q = f.e2.dot(d), r = planes[k].normal.dot(d);
      Vector6 m;
      m << 1, p, q, p * p, p * q, q * q;
      f.a.noalias() += m * m.transpose();
      f.b += r * m;
      f.rr += r * r;
      f.n += 1;
    }
  std::vector<Bend> bends(planes.size());
  for (std::size_t k = 0; k < planes.size(); ++k) {
    Frame& f = frames[k];
    if (f.n < 12 || f.rr <= 0)
      continue;
    f.a.diagonal().array() += 1e-9 * f.n;
    const Vector6 x = f.a.ldlt().solve(f.b);
    bends[k].share = std::min(1.0, f.b.dot(x) / f.rr);
    // curvature along each direction times the region's length in that direction
    Eigen::Matrix2d hessian, spread;
    hessian << 2 * x(3), x(4), x(4), 2 * x(5);
    const double p = f.a(0, 1) / f.n, q = f.a(0, 2) / f.n;
    spread << f.a(0, 3) / f.n - p * p, f.a(0, 4) / f.n - p * q, f.a(0, 4) / f.n - p * q,
        f.a(0, 5) / f.n - q * q;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    for (int j = 0; j < 2; ++j) {
      const Eigen::Vector2d axis = axes.eigenvectors().col(j);
      const double length = std::sqrt(12 * std::max(0.0, axes.eigenvalues()(j)));
      bends[k].angle =
          std::max(bends[k].angle, std::abs(axis.dot(hessian * axis)) * length);
    }
  }
  return bends;
}

} // namespace pcl_mrf_planes::adaptive
