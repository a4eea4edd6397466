// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/tile_sums.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl_mrf_planes::adaptive {

FittedPlane fitSums(const TileSums& sums)
{
  FittedPlane plane;
  plane.n = sums.n;
  if (sums.n < 3)
    return plane;
  plane.noise = sums.noise / sums.n;
  plane.centroid = sums.centroid();
  const Eigen::Matrix3d covariance = sums.covariance();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  plane.normal = solver.eigenvectors().col(0);
  plane.d = -plane.normal.dot(plane.centroid);
  plane.orientTowardsOrigin();
  // The Rayleigh quotient is second order in the error of the closed form's vector.
  plane.mse = std::max(0.0, plane.normal.dot(covariance * plane.normal));
  plane.width = std::sqrt(std::max(0.0, solver.eigenvalues()[1]));
  plane.extent = std::sqrt(std::max(0.0, solver.eigenvalues()[2]));
  return plane;
}

} // namespace pcl_mrf_planes::adaptive
