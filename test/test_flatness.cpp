// SPDX-License-Identifier: BSD-3-Clause
//
// How far planes may bend, by their size and the noise of their points.
#include "adaptive/flatness.h"
#include "adaptive/plane_merging.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_mrf_planes::adaptive {
namespace {

FittedPlane planeOf(double extent, double sigma)
{
  FittedPlane plane;
  plane.normal = Eigen::Vector3d(0, 0, -1);
  plane.d = 2;
  plane.centroid = Eigen::Vector3d(0, 0, 2);
  plane.n = 5000;
  plane.extent = extent;
  plane.width = extent;
  plane.noise = sigma * sigma;
  return plane;
}

AdaptiveParameters someParameters()
{
  AdaptiveParameters p;
  p.flatness = 0.01;
  p.max_flatness = 0.004;
  p.flatness_noise = 0.002;
  p.quiet_flatness = 0.25;
  return p;
}

TEST(FlatnessTest, SmallPlanesBendByTheirExtentWhateverTheNoise)
{
  for (const double sigma : {0.0, 0.001, 0.1})
    EXPECT_DOUBLE_EQ(flatnessOf(planeOf(0.05, sigma), someParameters()), 0.0005);
}

TEST(FlatnessTest, LargePlanesBendByTheirNoise)
{
  const AdaptiveParameters p = someParameters();
  EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, 0.0), p), 0.001) << "a quarter, without noise";
  EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, 0.0004), p), 0.001);
  EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, 0.001), p), 0.002) << "half of the noise";
  EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, 0.002), p), 0.004);
  EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, 0.5), p), 0.004) << "no more than that";
}

TEST(FlatnessTest, MoreNoiseNeverAllowsLess)
{
  AdaptiveParameters p;
  p.quiet_flatness = 0.55;
  double before = 0;
  for (int step = 0; step < 300; ++step) {
    const double sigma = 1e-5 * step;
    const double bend = flatnessOf(planeOf(1, sigma), p);
    EXPECT_GE(bend, before);
    before = bend;
  }
  EXPECT_DOUBLE_EQ(before, p.max_flatness);
}

TEST(FlatnessTest, SwitchedOffTheNoiseDoesNotCount)
{
  AdaptiveParameters p = someParameters();
  p.quiet_flatness = 1;
  for (const double sigma : {0.0, 0.001, 0.1})
    EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, sigma), p), 0.004);
  p.quiet_flatness = 0.25;
  p.flatness_noise = 0;
  for (const double sigma : {0.0, 0.001, 0.1})
    EXPECT_DOUBLE_EQ(flatnessOf(planeOf(2, sigma), p), 0.004) << "any noise is enough";
}

TEST(FlatnessTest, ASurfaceThatBendsByMillimetresIsAPlaneForANoisySensorOnly)
{
  NoiseLaw noise;
  noise.growth = {1.0};
  AdaptiveParameters p;
  p.quiet_flatness = 0.55;
  const double bend = 0.003; // rms: two times 2 mm allow it, two times 1.1 mm do not
  for (const double sigma : {0.0001, 0.0012}) {
    FittedPlane plane = planeOf(1, sigma);
    plane.mse = bend * bend;
    EXPECT_EQ(isPlane(plane, 60, noise, p), sigma > 0.001) << sigma;
  }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
