// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/scatter_matrix.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes {

namespace {

/// Points whose second spread is below this share of the first lie on a line.
constexpr double LINE_SHARE = 1e-10;

/// Error figures from the smallest eigenvalue, the sum of squared distances.
void setErrors(double squared_sum, double n, PlaneFitResult& result)
{
  result.error = std::sqrt(std::max(0.0, squared_sum));
  result.rms = result.error / std::sqrt(n);
}

} // namespace

Eigen::Matrix4d ScatterMatrix::matrix() const
{
  Eigen::Matrix4d m;
  m << xx, xy, xz, x, //
      xy, yy, yz, y,  //
      xz, yz, zz, z,  //
      x, y, z, n;
  return m;
}

Eigen::Matrix3d ScatterMatrix::covariance() const
{
  const Eigen::Vector3d mean = centroid();
  Eigen::Matrix3d moments;
  moments << xx, xy, xz, //
      xy, yy, yz,        //
      xz, yz, zz;
  return moments / n - mean * mean.transpose();
}

double ScatterMatrix::rmsDistance(const Plane& plane) const
{
  Eigen::Vector4d alpha;
  alpha << plane.normal, plane.d;
  return std::sqrt(std::max(0.0, alpha.dot(matrix() * alpha)) / n);
}

PlaneFitResult fitPlane(const ScatterMatrix& sums, PlaneFit fit)
{
  PlaneFitResult result;
  if (sums.n < 3.0)
    return result;

  // Both fits need the spread of the points: on a line or in one spot no plane is
  // determined, whatever the smallest eigenvector says.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(sums.covariance());
  const Eigen::Vector3d& variances = spread.eigenvalues();
  if (!(variances[1] > LINE_SHARE * variances[2]) || !(variances[2] > 0.0))
    return result;

  if (fit == PlaneFit::GEOMETRIC) {
    result.plane.normal = spread.eigenvectors().col(0);
    result.plane.d = -result.plane.normal.dot(sums.centroid());
    setErrors(variances[0] * sums.n, sums.n, result);
  }
  else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> scatter(sums.matrix());
    const Eigen::Vector4d alpha = scatter.eigenvectors().col(0);
    const double eta = alpha.head<3>().norm();
    if (!(eta > 1e-12)) // the plane at infinity: nothing was measured near the sensor
      return result;
    result.plane.normal = alpha.head<3>() / eta;
    result.plane.d = alpha[3] / eta;
    setErrors(scatter.eigenvalues()[0] / (eta * eta), sums.n, result);
  }
  result.plane.orientTowardsOrigin();
  result.valid = true;
  return result;
}

} // namespace pcl_mrf_planes
