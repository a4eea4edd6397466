// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"
#include "reference/plane_fit.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_mrf_planes {
namespace {

using reference::Points;

ScatterMatrix sumsOf(const Points& points)
{
  ScatterMatrix sums;
  for (const auto& p : points)
    sums.add(p.x(), p.y(), p.z());
  return sums;
}

/// A square patch of a random plane around a point at a distance from the sensor.
struct Patch {
  Points points;
  Eigen::Vector4d truth;
};

Patch makePatch(std::uint64_t seed, double range, double size, double noise, int count)
{
  scenes::Random random(seed);
  const Eigen::Vector3d centre = range * reference::randomUnit(random);
  Eigen::Vector3d normal;
  do {
    normal = reference::randomUnit(random);
  } while (std::abs(normal.dot(centre.normalized())) < 0.3); // not edge on
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  Patch patch;
  patch.truth << normal, -normal.dot(centre);
  patch.truth = reference::towardsSensor(patch.truth);
  for (int i = 0; i < count; ++i)
    patch.points.push_back(centre + random.uniform(-size / 2, size / 2) * u +
                           random.uniform(-size / 2, size / 2) * v +
                           noise * random.normal() * normal);
  return patch;
}

double farthestFrom(const Plane& plane, const Eigen::Vector4d& truth,
                    const Points& points)
{
  double farthest = 0.0;
  for (const auto& p : points)
    farthest =
        std::max(farthest, std::abs(plane.distance(p) - reference::distance(truth, p)));
  return farthest;
}

class PlaneFitTest : public testing::TestWithParam<PlaneFit> {
protected:
  static reference::Fit referenceFit(const Points& points)
  {
    return GetParam() == PlaneFit::ALGEBRAIC ? reference::fitAlgebraic(points)
                                             : reference::fitGeometric(points);
  }
};

INSTANTIATE_TEST_SUITE_P(Fits, PlaneFitTest,
                         testing::Values(PlaneFit::ALGEBRAIC, PlaneFit::GEOMETRIC),
                         [](const auto& param) {
                           return param.param == PlaneFit::ALGEBRAIC ? "Algebraic"
                                                                     : "Geometric";
                         });

TEST(ScatterMatrixTest, IsTheProductOfTheMonomials)
{
  const Patch patch = makePatch(1, 2.0, 0.5, 0.1, 100);
  const Eigen::MatrixXd m = reference::monomials(patch.points);
  const ScatterMatrix sums = sumsOf(patch.points);
  EXPECT_LT((sums.matrix() - m.transpose() * m).norm(), 1e-10)
      << "equation (4) is wrong";
  const Eigen::MatrixXd c = reference::centred(patch.points);
  EXPECT_LT((sums.covariance() - c.transpose() * c / 100.0).norm(), 1e-12)
      << "the covariance is not that of the points";
  EXPECT_LT((sums.centroid() - reference::mean(patch.points)).norm(), 1e-12);
  EXPECT_EQ(sums.n, 100.0);
}

TEST(ScatterMatrixTest, PoolingIsUnion)
{
  const Patch all = makePatch(2, 3.0, 1.0, 0.05, 90);
  ScatterMatrix pooled;
  for (std::size_t start = 0; start < 90; start += 30)
    pooled += sumsOf({all.points.begin() + static_cast<std::ptrdiff_t>(start),
                      all.points.begin() + static_cast<std::ptrdiff_t>(start) + 30});
  const ScatterMatrix whole = sumsOf(all.points);
  EXPECT_EQ(pooled.n, whole.n);
  EXPECT_LT((pooled.matrix() - whole.matrix()).norm(), 1e-10 * whole.matrix().norm())
      << "sums of parts must add up to the sums of the whole";
}

TEST(ScatterMatrixTest, RmsDistanceToAnyPlane)
{
  const Patch patch = makePatch(3, 2.0, 0.5, 0.02, 200);
  scenes::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Plane plane = reference::randomPlane(random);
    double sum = 0.0;
    for (const auto& p : patch.points)
      sum += std::pow(plane.distance(p), 2);
    EXPECT_NEAR(sumsOf(patch.points).rmsDistance(plane), std::sqrt(sum / 200), 1e-9)
        << "the sums must give the distances without the points";
  }
}

TEST_P(PlaneFitTest, AgreesWithTheSingularValueDecomposition)
{
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Patch patch =
        makePatch(seed, 0.5 + 0.1 * static_cast<double>(seed), 0.4, 0.01, 60);
    const reference::Fit expected = referenceFit(patch.points);
    const PlaneFitResult fit = fitPlane(sumsOf(patch.points), GetParam());
    ASSERT_TRUE(fit.valid) << "seed " << seed;
    EXPECT_LT((fit.plane.normal - expected.plane.head<3>()).norm(), 1e-8)
        << "another normal than the decomposition of the points, seed " << seed;
    EXPECT_NEAR(fit.plane.d, expected.plane[3], 1e-7) << "seed " << seed;
    EXPECT_NEAR(fit.error, expected.error, 1e-7)
        << "sqrt(lambda_min) / eta, seed " << seed;
    EXPECT_NEAR(fit.rms, expected.rms, 1e-8) << "seed " << seed;
    EXPECT_NEAR(fit.plane.normal.norm(), 1.0, 1e-12) << "eta must be divided out";
    EXPECT_GE(fit.plane.d, 0.0) << "the plane must be turned to the sensor";
  }
}

TEST_P(PlaneFitTest, IsExactWithoutNoise)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Patch patch = makePatch(seed, 3.0, 0.5, 0.0, 50);
    const PlaneFitResult fit = fitPlane(sumsOf(patch.points), GetParam());
    ASSERT_TRUE(fit.valid);
    EXPECT_LT(farthestFrom(fit.plane, patch.truth, patch.points), 1e-9)
        << "points of a plane must give that plane, seed " << seed;
    EXPECT_LT(fit.rms, 1e-6) << "points of a plane are at no distance, seed " << seed;
  }
}

TEST_P(PlaneFitTest, AtOneKilometreIsGoodToAMillimetre)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Patch patch = makePatch(seed, 1000.0, 1.0, 0.0, 1600);
    for (auto& p : patch.points)
      p = p.cast<float>().cast<double>(); // what a cloud can hold
    const PlaneFitResult fit = fitPlane(sumsOf(patch.points), GetParam());
    ASSERT_TRUE(fit.valid) << "seed " << seed;
    EXPECT_LT(farthestFrom(fit.plane, patch.truth, patch.points), 1e-3)
        << "cancellation of large sums spoils the plane, seed " << seed;
    EXPECT_LT(fit.rms, 1e-3) << "cancellation of large sums spoils the error";
  }
}

TEST(PlaneFitComparisonTest, CancellationInTheCovarianceAtRange)
{
  for (const double range : {10.0, 100.0, 1000.0}) {
    const Patch patch = makePatch(7, range, 1.0, 0.01, 1600);
    const Eigen::MatrixXd c = reference::centred(patch.points);
    const Eigen::Matrix3d exact = c.transpose() * c / 1600.0;
    const double off = (sumsOf(patch.points).covariance() - exact).norm();
    // Sums of 1600 terms of size range^2, each rounded to 2^-53 of itself.
    EXPECT_LT(off, 5e-15 * range * range)
        << "more than rounding was lost at " << range << " m";
  }
}

TEST(PlaneFitComparisonTest, GeometricIsNeverWorseInPerpendicularDistance)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Patch patch = makePatch(seed, 2.5, 0.5, 0.02, 100);
    const ScatterMatrix sums = sumsOf(patch.points);
    const PlaneFitResult geometric = fitPlane(sums, PlaneFit::GEOMETRIC);
    const PlaneFitResult algebraic = fitPlane(sums, PlaneFit::ALGEBRAIC);
    EXPECT_NEAR(geometric.rms, sums.rmsDistance(geometric.plane), 1e-9)
        << "the geometric error is the distance of the points";
    EXPECT_LE(geometric.rms, sums.rmsDistance(algebraic.plane) + 1e-12)
        << "GEOMETRIC must be the exact minimiser of (3), seed " << seed;
  }
}

TEST(PlaneFitComparisonTest, AlgebraicIsCloseToGeometricForTilesOfACamera)
{
  // Half a metre of wall at 1 to 4 m with a Kinect's noise: what section IV-A meets.
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const double range = 1.0 + 0.015 * static_cast<double>(seed);
    const double sigma = 1.425e-3 * range * range;
    const Patch patch = makePatch(seed, range, 0.2 * range, sigma, 1600);
    const ScatterMatrix sums = sumsOf(patch.points);
    const PlaneFitResult geometric = fitPlane(sums, PlaneFit::GEOMETRIC);
    const PlaneFitResult algebraic = fitPlane(sums, PlaneFit::ALGEBRAIC);
    const double angle =
        std::acos(std::min(1.0, geometric.plane.normal.dot(algebraic.plane.normal)));
    EXPECT_LT(angle, 0.02) << "further apart than a degree, seed " << seed;
    EXPECT_LT(sums.rmsDistance(algebraic.plane), 1.05 * geometric.rms)
        << "the algebraic plane is 5 % worse than the best, seed " << seed;
    EXPECT_NEAR(algebraic.rms / geometric.rms, 1.0, 0.05)
        << "sqrt(lambda_min) / eta is no estimate of the distance, seed " << seed;
  }
}

TEST(PlaneFitComparisonTest, GeometricFitMovesWithThePoints)
{
  const Patch patch = makePatch(5, 2.0, 0.5, 0.02, 100);
  const PlaneFitResult at_home = fitPlane(sumsOf(patch.points), PlaneFit::GEOMETRIC);
  const Eigen::Vector3d shift(10, -20, 5);
  Points moved;
  for (const auto& p : patch.points)
    moved.push_back(p + shift);
  const PlaneFitResult away = fitPlane(sumsOf(moved), PlaneFit::GEOMETRIC);
  EXPECT_NEAR(std::abs(at_home.plane.normal.dot(away.plane.normal)), 1.0, 1e-9)
      << "a shift must not turn the plane";
  EXPECT_NEAR(at_home.rms, away.rms, 1e-9) << "a shift must not change the error";
}

TEST(PlaneFitComparisonTest, PointsAllAroundTheSensorHaveNoAlgebraicPlane)
{
  // The corners of an octahedron: by algebra the plane at infinity is the nearest.
  const Points corners = {{9, 0, 0},  {-9, 0, 0}, {0, 8, 0},
                          {0, -8, 0}, {0, 0, 7},  {0, 0, -7}};
  EXPECT_FALSE(fitPlane(sumsOf(corners), PlaneFit::ALGEBRAIC).valid);
  const PlaneFitResult geometric = fitPlane(sumsOf(corners), PlaneFit::GEOMETRIC);
  ASSERT_TRUE(geometric.valid);
  EXPECT_NEAR(std::abs(geometric.plane.normal.z()), 1.0, 1e-9) << "the shortest axis";
  EXPECT_NEAR(geometric.plane.d, 0.0, 1e-9);
}

TEST_P(PlaneFitTest, FewPointsLinesAndSpotsHaveNoPlane)
{
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d step(0.1, -0.2, 0.3);
  EXPECT_FALSE(fitPlane({}, GetParam()).valid) << "no point";
  EXPECT_FALSE(fitPlane(sumsOf({a}), GetParam()).valid) << "one point";
  EXPECT_FALSE(fitPlane(sumsOf({a, a + step}), GetParam()).valid) << "two points";
  EXPECT_FALSE(fitPlane(sumsOf({a, a + step, a + 2 * step}), GetParam()).valid)
      << "three points on a line";
  EXPECT_FALSE(fitPlane(sumsOf(Points(50, a)), GetParam()).valid) << "one spot";
  EXPECT_FALSE(fitPlane(sumsOf(Points(50, Eigen::Vector3d::Zero())), GetParam()).valid)
      << "all at the sensor";
  Points line;
  for (int i = 0; i < 1600; ++i)
    line.push_back(a + i * 1e-3 * step);
  EXPECT_FALSE(fitPlane(sumsOf(line), GetParam()).valid) << "a line";
  const PlaneFitResult three =
      fitPlane(sumsOf({a, a + step, a + Eigen::Vector3d(0, 1, 0)}), GetParam());
  EXPECT_TRUE(three.valid) << "three points span a plane";
  EXPECT_LT(three.rms, 1e-7) << "three points lie on their plane";
}

TEST_P(PlaneFitTest, APlaneThroughTheSensorIsFound)
{
  scenes::Random random(9);
  Points points;
  for (int i = 0; i < 100; ++i)
    points.emplace_back(random.uniform(-1, 1), 0.0, random.uniform(1, 2));
  const PlaneFitResult fit = fitPlane(sumsOf(points), GetParam());
  ASSERT_TRUE(fit.valid);
  EXPECT_NEAR(std::abs(fit.plane.normal.y()), 1.0, 1e-9);
  EXPECT_NEAR(fit.plane.d, 0.0, 1e-9);
}

} // namespace
} // namespace pcl_mrf_planes
