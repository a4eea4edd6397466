// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <vector>

/** Plain, slow implementations written from the paper, to hold the library against. */
namespace pcl_mrf_planes::reference {

using Points = std::vector<Eigen::Vector3d>;

/** \brief A least-squares plane a x + b y + c z + d = 0, (a, b, c) of unit length. */
struct Fit {
  bool valid = false;
  Eigen::Vector4d plane = Eigen::Vector4d::Zero();
  double error = 0.0; ///< root of the sum of squared errors as section IV-A states it
  double rms = 0.0;   ///< error / sqrt(number of points)
};

/** \brief Turn a plane to the sensor: d >= 0. */
inline Eigen::Vector4d towardsSensor(const Eigen::Vector4d& plane)
{
  return plane[3] < 0.0 ? Eigen::Vector4d(-plane) : plane;
}

inline double distance(const Eigen::Vector4d& plane, const Eigen::Vector3d& point)
{
  return plane.dot(point.homogeneous());
}

inline Eigen::Vector3d mean(const Points& points)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& p : points)
    sum += p;
  return sum / static_cast<double>(points.size());
}

/** \brief The points less their mean, one a row. */
inline Eigen::MatrixXd centred(const Points& points)
{
  Eigen::MatrixXd m(static_cast<Eigen::Index>(points.size()), 3);
  const Eigen::Vector3d middle = mean(points);
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    m.row(i) = points[static_cast<std::size_t>(i)] - middle;
  return m;
}

/** \brief The matrix M of planar monomials [X Y Z 1], before equation (4). */
inline Eigen::MatrixXd monomials(const Points& points)
{
  Eigen::MatrixXd m(static_cast<Eigen::Index>(points.size()), 4);
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    m.row(i) = points[static_cast<std::size_t>(i)].homogeneous();
  return m;
}

/** \brief True where three points or more span more than a line. */
inline bool spansPlane(const Points& points)
{
  if (points.size() < 3)
    return false;
  const Eigen::VectorXd s =
      Eigen::JacobiSVD<Eigen::MatrixXd>(centred(points)).singularValues();
  return s[0] > 0.0 && s[1] > 1e-5 * s[0];
}

/** \brief The smallest right singular vector of M, that is the eigenvector of M^t M
 * with the smallest eigenvalue; divided by eta. */
inline Fit fitAlgebraic(const Points& points)
{
  Fit fit;
  if (!spansPlane(points))
    return fit;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(monomials(points), Eigen::ComputeThinV);
  const Eigen::Vector4d alpha = svd.matrixV().col(3);
  const double eta = alpha.head<3>().norm();
  const double smallest =
      svd.singularValues().size() == 4 ? svd.singularValues()[3] : 0;
  fit.valid = true;
  fit.plane = towardsSensor(alpha / eta);
  fit.error = smallest / eta; // sqrt(lambda_min) / eta
  fit.rms = fit.error / std::sqrt(static_cast<double>(points.size()));
  return fit;
}

/** \brief The plane of least perpendicular distances, equation (3): through the mean,
 * normal to the two directions of most spread. */
inline Fit fitGeometric(const Points& points)
{
  Fit fit;
  if (!spansPlane(points))
    return fit;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred(points), Eigen::ComputeThinV);
  const Eigen::Vector3d normal = svd.matrixV().col(2);
  Eigen::Vector4d plane;
  plane << normal, -normal.dot(mean(points));
  fit.valid = true;
  fit.plane = towardsSensor(plane);
  for (const auto& p : points)
    fit.error += std::pow(distance(plane, p), 2);
  fit.error = std::sqrt(fit.error);
  fit.rms = fit.error / std::sqrt(static_cast<double>(points.size()));
  return fit;
}

} // namespace pcl_mrf_planes::reference
