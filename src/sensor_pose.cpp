// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/sensor_pose.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

constexpr double NARROWEST = 1.0 / 20.0; // rms radius to distance
constexpr double WORST_PIXELS = 1.0;     // rms reprojection error that is accepted
constexpr double AMBIGUOUS = 1e-9;       // second to last eigenvalue of a planar scene
constexpr std::size_t FEWEST = 6;        // sightings that determine eleven numbers

using Projection = Eigen::Matrix<double, 3, 4>;

/// Mean and rms radius, with which the numbers of the linear system become of order
/// one.
template <int N>
struct Scale {
  using Vector = Eigen::Matrix<double, N, 1>;
  Vector mean = Vector::Zero();
  double radius = 0.0;
  Vector apply(const Vector& v) const { return (v - mean) / radius; }
};

template <int N, typename Get>
Scale<N> scaleOf(const std::vector<Sighting>& all, Get get)
{
  Scale<N> scale;
  for (const Sighting& s : all)
    scale.mean += get(s);
  scale.mean /= static_cast<double>(all.size());
  for (const Sighting& s : all)
    scale.radius += (get(s) - scale.mean).squaredNorm();
  scale.radius = std::sqrt(scale.radius / static_cast<double>(all.size()));
  return scale;
}

Scale<3> pointScale(const std::vector<Sighting>& all)
{
  return scaleOf<3>(all, [](const Sighting& s) { return s.point; });
}

/// The null vector of the equations u (p3 X) = p1 X and v (p3 X) = p2 X.
bool solveProjection(const std::vector<Sighting>& all, const Scale<3>& points,
                     const Scale<2>& pixels, Projection& projection)
{
  Eigen::Matrix<double, 12, 12> normal = Eigen::Matrix<double, 12, 12>::Zero();
  for (const Sighting& s : all) {
    const Eigen::RowVector4d x = points.apply(s.point).homogeneous().transpose();
    const Eigen::Vector2d uv = pixels.apply(s.pixel);
    Eigen::Matrix<double, 2, 12> rows = Eigen::Matrix<double, 2, 12>::Zero();
    rows.block<1, 4>(0, 0) = x;
    rows.block<1, 4>(0, 8) = -uv[0] * x;
    rows.block<1, 4>(1, 4) = x;
    rows.block<1, 4>(1, 8) = -uv[1] * x;
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 12, 12>> solver(normal);
  if (!(solver.eigenvalues()[1] > AMBIGUOUS * solver.eigenvalues()[11]))
    return false;
  const Eigen::Matrix<double, 12, 1> p = solver.eigenvectors().col(0);
  projection << p.segment<4>(0).transpose(), p.segment<4>(4).transpose(),
      p.segment<4>(8).transpose();
  return true;
}

bool explains(const Projection& projection, const std::vector<Sighting>& all,
              const Scale<3>& points, const Scale<2>& pixels)
{
  double squares = 0.0;
  for (const Sighting& s : all) {
    const Eigen::Vector3d image = projection * points.apply(s.point).homogeneous();
    const Eigen::Vector2d seen = image.hnormalized() * pixels.radius + pixels.mean;
    squares += (seen - s.pixel).squaredNorm();
  }
  // Written so that NaN fails.
  return squares <= WORST_PIXELS * WORST_PIXELS * static_cast<double>(all.size());
}

} // namespace

bool plausibleOrigin(const std::vector<Sighting>& sightings,
                     const Eigen::Vector3d& origin)
{
  if (sightings.empty())
    return true;
  const Scale<3> points = pointScale(sightings);
  return points.radius >= NARROWEST * (points.mean - origin).norm();
}

bool estimatePinholePose(const std::vector<Sighting>& sightings, SensorPose& pose)
{
  if (sightings.size() < FEWEST)
    return false;
  const Scale<3> points = pointScale(sightings);
  const Scale<2> pixels =
      scaleOf<2>(sightings, [](const Sighting& s) { return s.pixel; });
  Projection projection;
  if (!(points.radius > 0.0) || !(pixels.radius > 0.0) ||
      !solveProjection(sightings, points, pixels, projection) ||
      !explains(projection, sightings, points, pixels))
    return false;

  const Eigen::Matrix3d left = projection.leftCols<3>();
  const Eigen::Vector3d centre = -left.partialPivLu().solve(projection.col(3));
  // In units of the points' radius, from their middle. Parallel rays meet very far away or,
  // by rounding, nowhere; NaN fails.
  if (!(NARROWEST * centre.norm() <= 1.0))
    return false;
  Eigen::Vector3d axis = left.row(2).transpose().normalized();
  if (axis.dot(-centre) < 0.0) // the points are in front of the camera
    axis = -axis;
  pose.origin = centre * points.radius + points.mean;
  pose.rotation = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), axis)
                      .toRotationMatrix();
  return true;
}

} // namespace pcl_mrf_planes
