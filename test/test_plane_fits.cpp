// SPDX-License-Identifier: BSD-3-Clause
//
// Planes of many tiles at once against a plain eigenvalue solver.
#include "adaptive/tile_sums.h"
#include "scenes/random.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

namespace pcl_mrf_planes::adaptive {
namespace {

/// Sums of points around some place: flat, round or anything between.
TileSums randomSums(scenes::Random& random, int points)
{
  const Eigen::Vector3d centre(random.uniform(-2, 2), random.uniform(-2, 2),
                               random.uniform(0.5, 4));
  Eigen::Matrix3d spread;
  for (int k = 0; k < 9; ++k)
    spread(k / 3, k % 3) = random.normal();
  const double flatness = std::pow(10.0, random.uniform(-4, 0));
  TileSums sums;
  for (int k = 0; k < points; ++k) {
    const Eigen::Vector3d offset(random.normal(), random.normal(),
                                 flatness * random.normal());
    const Eigen::Vector3d p = centre + 0.05 * (spread * offset);
    sums.add(p.x(), p.y(), p.z());
  }
  sums.noise = 1e-6 * points;
  return sums;
}

void expectSameBits(const FittedPlane& a, const FittedPlane& b)
{
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.d, b.d);
  EXPECT_EQ(a.mse, b.mse);
  EXPECT_EQ(a.extent, b.extent);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.n, b.n);
  EXPECT_EQ(a.noise, b.noise);
  EXPECT_EQ(a.centroid, b.centroid);
}

TEST(PlaneFitsTest, AgreeWithAnEigenvalueSolver)
{
  scenes::Random random(1);
  for (int k = 0; k < 500; ++k) {
    const TileSums sums = randomSums(random, 3 + k % 60);
    const FittedPlane plane = fitSums(sums);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sums.covariance());
    const Eigen::Vector3d values = solver.eigenvalues().cwiseMax(0.0);
    const double trace = values.sum();
    ASSERT_GT(trace, 0.0);
    // Newton's method comes slowly to a root that is nearly a double one: points that are
    // as thick as they are wide, which are no plane anyway.
    const bool flat = values[0] < 0.3 * values[1];
    const double close = flat ? 1e-9 : 1e-5;
    EXPECT_NEAR(plane.mse, values[0], close * trace) << "least eigenvalue, case " << k;
    EXPECT_NEAR(plane.width, std::sqrt(values[1]), 1e3 * close * std::sqrt(trace)) << k;
    EXPECT_NEAR(plane.extent, std::sqrt(values[2]), 1e3 * close * std::sqrt(trace))
        << k;
    EXPECT_NEAR((plane.centroid - sums.centroid()).norm(), 0.0, 1e-12) << k;
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12) << k;
    EXPECT_GE(plane.d, 0.0) << "turned towards the origin";
    EXPECT_NEAR(plane.distance(plane.centroid), 0.0, 1e-12)
        << "a least-squares plane passes through the centroid";
    if (flat) { // else the normal is anyone's guess
      EXPECT_NEAR(std::abs(plane.normal.dot(solver.eigenvectors().col(0))), 1.0, 1e-6)
          << k;
    }
    EXPECT_EQ(plane.n, sums.n);
    EXPECT_DOUBLE_EQ(plane.noise, 1e-6);
  }
}

TEST(PlaneFitsTest, AreTheSameBitsInAnyCompany)
{
  scenes::Random random(2);
  std::vector<TileSums> sums;
  for (int k = 0; k < 37; ++k)
    sums.push_back(randomSums(random, k)); // the first ones too few for a plane
  for (std::size_t count = 0; count <= sums.size(); ++count) {
    std::vector<FittedPlane> planes(count);
    fitPlanes(sums.data(), count, planes.data());
    for (std::size_t k = 0; k < count; ++k)
      expectSameBits(planes[k], fitSums(sums[k]));
  }
}

TEST(PlaneFitsTest, FewerThanThreePointsHaveNoPlane)
{
  scenes::Random random(3);
  for (int points = 0; points < 3; ++points) {
    const FittedPlane plane = fitSums(randomSums(random, points));
    EXPECT_EQ(plane.n, points);
    EXPECT_EQ(plane.mse, 0.0);
    EXPECT_EQ(plane.extent, 0.0);
    EXPECT_EQ(plane.normal, Eigen::Vector3d::UnitZ());
  }
}

TEST(PlaneFitsTest, PointsOnALineOrInOneSpotGiveSomePlaneThroughThem)
{
  TileSums line, spot;
  for (int k = 0; k < 16; ++k) {
    line.add(0.25 * k, 1.0, 2.0);
    spot.add(0.5, 0.25, 2.0);
  }
  for (const TileSums& sums : {line, spot}) {
    const FittedPlane plane = fitSums(sums);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-9);
    EXPECT_NEAR(plane.distance(plane.centroid), 0.0, 1e-12);
    EXPECT_NEAR(plane.mse, 0.0, 1e-12);
    EXPECT_NEAR(plane.width, 0.0, 1e-6);
  }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
