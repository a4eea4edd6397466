// SPDX-License-Identifier: BSD-3-Clause
#include "plane_patch.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_mrf_planes::benchmarks {

namespace {

/// Coefficients of the characteristic polynomial of a symmetric 3x3 matrix.
struct Invariants {
  double trace, minors, determinant;
};

Invariants invariantsOf(const Eigen::Matrix3d& a)
{
  return {a.trace(),
          a(0, 0) * a(1, 1) - a(0, 1) * a(0, 1) + a(0, 0) * a(2, 2) -
              a(0, 2) * a(0, 2) + a(1, 1) * a(2, 2) - a(1, 2) * a(1, 2),
          a.determinant()};
}

/// By Newton's method from 0, which rises to the least root of a polynomial whose
/// roots are all real; for what is nearly a plane in two or three steps.
double leastEigenvalue(const Invariants& p)
{
  constexpr int MOST_STEPS = 20;
  constexpr double EXACT = 1e-12; // of the trace
  double root = 0.0;
  for (int step = 0; step < MOST_STEPS; ++step) {
    const double value = p.determinant - root * (p.minors - root * (p.trace - root));
    const double slope = p.minors - root * (2.0 * p.trace - 3.0 * root);
    if (!(slope > 0.0))
      break;
    const double change = value / slope;
    root += change;
    if (change < EXACT * p.trace)
      break;
  }
  return std::max(0.0, root);
}

/// The longest product of two rows of the matrix less the eigenvalue.
Eigen::Vector3d eigenvector(Eigen::Matrix3d a, double eigenvalue)
{
  a.diagonal().array() -= eigenvalue;
  const std::array<Eigen::Vector3d, 3> products = {
      a.col(0).cross(a.col(1)), a.col(1).cross(a.col(2)), a.col(2).cross(a.col(0))};
  const auto longest = std::max_element(
      products.begin(), products.end(),
      [](const auto& p, const auto& q) { return p.squaredNorm() < q.squaredNorm(); });
  const double length = longest->norm();
  return length > 0.0 ? Eigen::Vector3d(*longest / length) : Eigen::Vector3d::UnitZ();
}

} // namespace

void PlanePatch::fit()
{
  const Eigen::Matrix3d covariance = sums.covariance();
  const Invariants invariants = invariantsOf(covariance);
  centre = sums.centroid();
  mse = leastEigenvalue(invariants);
  normal = eigenvector(covariance, mse);
  if (normal.dot(centre) > 0.0)
    normal = -normal;
  // The other two eigenvalues have this sum and this product.
  const double sum = invariants.trace - mse;
  const double product = invariants.minors - mse * sum;
  const double root = std::sqrt(std::max(0.0, sum * sum / 4.0 - product));
  const double second = sum / 2.0 - root;
  flatness = second / std::max(mse, 1e-300);
}

double meanSquaredDistance(const ScatterMatrix& sums)
{
  return leastEigenvalue(invariantsOf(sums.covariance()));
}

} // namespace pcl_mrf_planes::benchmarks
