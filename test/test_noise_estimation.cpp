// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/noise_estimation.h"
#include "adaptive/tile_rms.h"

#include "scenes/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_mrf_planes::adaptive {
namespace {

constexpr int WIDTH = 320;
constexpr int HEIGHT = 256;
constexpr int SIDE = 16; // of a patch, points
constexpr double SIGMA = 0.01;

/// The point that a pinhole camera sees at a depth.
void setDepth(OrganizedPoints& points, int u, int v, double z)
{
  constexpr double FOCAL_LENGTH = 300.0;
  points.set(static_cast<std::size_t>(v * WIDTH + u),
             static_cast<float>(z * (u - WIDTH / 2) / FOCAL_LENGTH),
             static_cast<float>(z * (v - HEIGHT / 2) / FOCAL_LENGTH),
             static_cast<float>(z));
}

/// Patches seen from the front, 2 m away at the top and 10 m at the bottom. Of those beyond
/// 6 m a share is clutter, thicker the farther it is.
OrganizedPoints patches(double clutter)
{
  scenes::Random random(5);
  OrganizedPoints points;
  points.resize(WIDTH, HEIGHT);
  points.depth_measure = DepthMeasure::OPTICAL_AXIS;
  for (int top = 0; top < HEIGHT; top += SIDE)
    for (int left = 0; left < WIDTH; left += SIDE) {
      const double depth = 2.0 + 8.0 * top / HEIGHT;
      const bool is_clutter = depth > 6.0 && random.uniform() < clutter;
      const double thickness = 0.1 * (depth / 6.0) * (depth / 6.0);
      for (int v = top; v < top + SIDE; ++v)
        for (int u = left; u < left + SIDE; ++u) {
          const double z = depth + (is_clutter ? thickness * (random.uniform() - 0.5)
                                               : SIGMA * random.normal());
          setDepth(points, u, v, z);
        }
    }
  return points;
}

NoiseLaw noiseOf(const OrganizedPoints& points)
{
  const AdaptiveParameters parameters;
  return estimateNoise(buildTilePyramid(points, parameters), parameters);
}

TEST(PercentileTest, IsThatOfTheNumbersInTheirOrder)
{
  FrameVector<double> none;
  EXPECT_EQ(percentile(none, 0.5), 0.0);
  scenes::Random random(4);
  for (const std::size_t count : {1U, 2U, 11U, 100U})
    for (const double share : {0.0, 0.3, 0.5, 1.0}) {
      FrameVector<double> numbers;
      for (std::size_t k = 0; k < count; ++k)
        numbers.push_back(random.normal());
      FrameVector<double> sorted = numbers;
      std::sort(sorted.begin(), sorted.end());
      const double place = share * static_cast<double>(count - 1);
      EXPECT_EQ(percentile(numbers, share), sorted[static_cast<std::size_t>(place)]);
    }
}

TEST(NoiseEstimationTest, FindsTheNoiseOfSurfacesAtAllDepths)
{
  const NoiseLaw noise = noiseOf(patches(0.0));
  for (const double z : {2.5, 5.0, 9.0})
    EXPECT_NEAR(noise.small(z), SIGMA, 0.25 * SIGMA) << "at " << z << " m";
}

TEST(NoiseEstimationTest, ClutterFarAwayIsNotNoise)
{
  const NoiseLaw noise = noiseOf(patches(0.7));
  EXPECT_NEAR(noise.small(2.5), SIGMA, 0.5 * SIGMA);
  EXPECT_LT(noise.small(9.0), 2.2 * SIGMA)
      << "seven in ten of the far patches, 10 to 25 cm thick, count as noise";
}

/// Patches 2 to 10 m away without any noise but depth in whole disparities: one in five faces the
/// sensor inside one disparity, across the others it falls by two or three.
OrganizedPoints roundedPatches()
{
  constexpr double FOCAL_LENGTH_TIMES_BASE = 345.0; // disparities of 1 / 8 pixel
  scenes::Random random(6);
  OrganizedPoints points;
  points.resize(WIDTH, HEIGHT);
  points.depth_measure = DepthMeasure::OPTICAL_AXIS;
  for (int top = 0; top < HEIGHT; top += SIDE)
    for (int left = 0; left < WIDTH; left += SIDE) {
      const double depth = 2.0 + 8.0 * top / HEIGHT;
      const double slope = random.chance(0.2) ? 0.0 : random.uniform(2.0, 3.0) / SIDE;
      for (int v = top; v < top + SIDE; ++v)
        for (int u = left; u < left + SIDE; ++u) {
          const double disparity = FOCAL_LENGTH_TIMES_BASE / depth - slope * (u - left);
          const double z = FOCAL_LENGTH_TIMES_BASE / std::round(disparity);
          setDepth(points, u, v, z);
        }
    }
  return points;
}

TEST(NoiseEstimationTest, TilesInsideOneDisparityDoNotTellOfQuiet)
{
  const NoiseLaw noise = noiseOf(roundedPatches());
  for (const double z : {2.5, 5.0, 9.0}) {
    const double disparity = z * z / 345.0; // in metres
    EXPECT_GT(noise.small(z), disparity / 8) << "at " << z << " m";
    EXPECT_LT(noise.small(z), disparity / 2) << "at " << z << " m";
  }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
