// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane.h>

#include <gtest/gtest.h>

namespace pcl_mrf_planes {
namespace {

constexpr double BETA = 0.4;

TEST(PlaneTest, OrientationMakesTheSignUnique)
{
  scenes::Random random(1);
  for (int i = 0; i < 200; ++i) {
    Plane plane;
    plane.normal = reference::randomUnit(random);
    plane.d = i % 5 == 0 ? 0.0 : random.uniform(-5, 5);
    Plane negated = {-plane.normal, -plane.d};
    const Eigen::Vector3d point(1.0, 2.0, 3.0);
    const double distance = std::abs(plane.distance(point));
    plane.orientTowardsOrigin();
    negated.orientTowardsOrigin();
    EXPECT_GE(plane.d, 0.0) << "the sensor must lie in front of the plane";
    EXPECT_EQ(plane.normal, negated.normal) << "alpha and -alpha are one plane";
    EXPECT_EQ(plane.d, negated.d) << "alpha and -alpha are one plane";
    EXPECT_EQ(std::abs(plane.distance(point)), distance)
        << "turning must not move the plane";
  }
}

TEST(PlaneTest, PlanesThroughTheSensorKeepOneSignOnEveryAxis)
{
  for (int axis = 0; axis < 3; ++axis) {
    Plane plane;
    plane.normal = -Eigen::Vector3d::Unit(axis);
    plane.d = 0.0;
    plane.orientTowardsOrigin();
    EXPECT_EQ(plane.normal, Eigen::Vector3d(Eigen::Vector3d::Unit(axis)))
        << "the first coefficient that is not zero must be positive";
  }
}

TEST(PlaneTest, DistanceIsSignedAndInMetres)
{
  const Plane plane = {Eigen::Vector3d(0, 0, -1), 2.0};
  EXPECT_DOUBLE_EQ(plane.distance({5, 7, 0.5}), 1.5);
  EXPECT_DOUBLE_EQ(plane.distance({5, 7, 2.5}), -0.5);
  EXPECT_EQ(plane.coefficient(2), -1.0);
  EXPECT_EQ(plane.coefficient(3), 2.0);
}

TEST(DissimilarityTest, IsSymmetricZeroForEqualPlanesAndNeverNegative)
{
  scenes::Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Plane p = reference::randomPlane(random);
    const Plane q = reference::randomPlane(random);
    EXPECT_EQ(dissimilarity(p, q, BETA), dissimilarity(q, p, BETA)) << "not symmetric";
    EXPECT_GE(dissimilarity(p, q, BETA), 0.0) << "a price must not be negative";
    EXPECT_NEAR(dissimilarity(p, p, BETA), 0.0, 1e-15) << "equal planes cost something";
    EXPECT_GE(dissimilarity(p, p, BETA), 0.0)
        << "rounding of the dot product must not make it negative";
  }
}

TEST(DissimilarityTest, IsEquationFive)
{
  const Plane floor = {Eigen::Vector3d::UnitY(), 1.0};
  const Plane wall = {Eigen::Vector3d::UnitX(), 1.5};
  EXPECT_NEAR(dissimilarity(floor, wall, BETA), 1.0 + BETA * 0.5, 1e-15)
      << "right angle and half a metre";
  const Plane table = {Eigen::Vector3d::UnitY(), 0.25};
  EXPECT_NEAR(dissimilarity(floor, table, BETA), BETA * 0.75, 1e-15)
      << "parallel planes";
  EXPECT_NEAR(dissimilarity(floor, table, 0.0), 0.0, 1e-15)
      << "beta = 0 ignores offsets";
  const Plane opposite = {-Eigen::Vector3d::UnitY(), 1.0};
  EXPECT_NEAR(dissimilarity(floor, opposite, BETA), 2.0, 1e-15)
      << "floor and ceiling face each other";
}

} // namespace
} // namespace pcl_mrf_planes
