// SPDX-License-Identifier: BSD-3-Clause
//
// Labels of all points from those of every so many-th.
#include "adaptive/sampled_points.h"
#include "reference/inputs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace pcl_mrf_planes::adaptive {
namespace {

TEST(SampledPointsTest, TheStepIsShorterWhereFewWouldBeLeft)
{
  const auto step = [](int width, int height, int sampling, int least) {
    OrganizedPoints points;
    points.resize(width, height);
    AdaptiveParameters parameters;
    parameters.sampling = sampling;
    parameters.least_samples = least;
    return samplingStep(points, parameters);
  };
  EXPECT_EQ(step(100, 50, 3, 0), 3) << "no least number";
  EXPECT_EQ(step(100, 50, 3, 34 * 17), 3) << "as many as the step leaves";
  EXPECT_EQ(step(100, 50, 3, 34 * 17 + 1), 2);
  EXPECT_EQ(step(100, 50, 3, 50 * 25), 2);
  EXPECT_EQ(step(100, 50, 3, 50 * 25 + 1), 1);
  EXPECT_EQ(step(100, 50, 3, 1000000), 1) << "more than there are";
  EXPECT_EQ(step(100, 50, 1, 1), 1);
}

TEST(SampledPointsTest, TakeEverySoManyth)
{
  scenes::Random random(1);
  for (const int width : {1, 2, 7, 16})
    for (const int height : {1, 3, 8})
      for (int every = 1; every <= 8; ++every) {
        const OrganizedPoints points = reference::randomPoints(random, width, height);
        const OrganizedPoints samples = samplePoints(points, every);
        ASSERT_EQ(samples.width, (width + every - 1) / every);
        ASSERT_EQ(samples.height, (height + every - 1) / every);
        for (int r = 0; r < samples.height; ++r)
          for (int c = 0; c < samples.width; ++c) {
            const auto i = static_cast<std::size_t>(r * every * width + c * every);
            const auto k = static_cast<std::size_t>(r * samples.width + c);
            EXPECT_EQ(samples.x[k], points.x[i]);
            EXPECT_EQ(samples.y[k], points.y[i]);
            EXPECT_EQ(samples.z[k], points.z[i]);
            EXPECT_EQ(samples.valid[k], points.valid[i]);
          }
      }
}

/// Two walls that meet in a vertical edge at the column \a edge, and a point on neither.
struct Crease {
  OrganizedPoints points;
  FrameVector<FittedPlane> planes;

  Crease(int width, int height, int edge)
  : planes(2)
  {
    points.resize(width, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u) {
        const float x = 0.01f * static_cast<float>(u - edge);
        const float y = 0.01f * static_cast<float>(v);
        points.set(static_cast<std::size_t>(v * width + u), x, y,
                   2.0f - 0.5f * std::abs(x));
      }
    for (std::size_t k = 0; k < 2; ++k) {
      planes[k].normal = Eigen::Vector3d(k == 0 ? 0.5 : -0.5, 0, -1).normalized();
      planes[k].d = -planes[k].normal.dot(Eigen::Vector3d(0, 0, 2));
      planes[k].n = 1000;
      planes[k].noise = 1e-6;
      planes[k].centroid = {0, 0, 2};
      planes[k].extent = 0.01;
    }
  }
};

NoiseLaw millimetre()
{
  NoiseLaw noise;
  noise.a = 0.001;
  noise.growth = {1, 1, 1, 1};
  return noise;
}

TEST(SampledPointsTest, BordersComeBackToThePoint)
{
  for (const int width : {16, 31, 40})
    for (int every = 1; every <= 5; ++every) {
      const int height = 13;
      const int edge = width / 2 + 1;
      Crease crease(width, height, edge);
      crease.points.clear(3);
      const OrganizedPoints samples = samplePoints(crease.points, every);
      std::vector<std::uint16_t> labels(samples.size());
      for (std::size_t k = 0; k < labels.size(); ++k)
        labels[k] = samples.valid[k] == 0 ? 0 : samples.x[k] < 0 ? 1 : 2;
      const auto all = spreadLabels(crease.points, samples, labels, every,
                                    crease.planes, millimetre(), {});
      for (std::size_t i = 0; i < all.size(); ++i) {
        if (crease.points.valid[i] == 0) {
          EXPECT_EQ(all[i], 0) << "an invalid point has no label";
        }
        else if (crease.points.x[i] != 0.0f) {
          EXPECT_EQ(all[i], crease.points.x[i] < 0 ? 1 : 2)
              << "point " << i << " of " << width << " columns, every " << every;
        }
      }
    }
}

TEST(SampledPointsTest, APointOffThePlaneGetsNoneOnlyWhereNoneIsNear)
{
  Crease crease(16, 16, 100); // one wall only
  const std::size_t off = 5 * 16 + 5;
  crease.points.set(off, crease.points.x[off], crease.points.y[off], 1.0f);
  const OrganizedPoints samples = samplePoints(crease.points, 2);
  std::vector<std::uint16_t> labels(samples.size(), 1);
  EXPECT_EQ(spreadLabels(crease.points, samples, labels, 2, crease.planes, millimetre(),
                         {})[off],
            1)
      << "between samples of one label a point takes it";
  labels[2 * 8 + 3] = 0; // beside it
  const auto all =
      spreadLabels(crease.points, samples, labels, 2, crease.planes, millimetre(), {});
  EXPECT_EQ(all[off], 0) << "no plane costs less than a metre from the plane";
  EXPECT_EQ(all[4 * 16 + 5], 1) << "a point on the plane keeps its label";
}

TEST(SampledPointsTest, LabelsAreThoseOfTheCornersAround)
{
  scenes::Random random(4);
  const Crease crease(23, 17, 9);
  for (int every = 1; every <= 8; ++every) {
    const OrganizedPoints samples = samplePoints(crease.points, every);
    std::vector<std::uint16_t> labels(samples.size());
    for (auto& label : labels)
      label = static_cast<std::uint16_t>(random.uniform(0, 3));
    const auto all = spreadLabels(crease.points, samples, labels, every, crease.planes,
                                  millimetre(), {});
    for (int v = 0; v < 17; ++v)
      for (int u = 0; u < 23; ++u) {
        std::set<int> around;
        for (int k = 0; k < 4; ++k) {
          const int c = std::min(u / every + k % 2, samples.width - 1);
          const int r = std::min(v / every + k / 2, samples.height - 1);
          around.insert(labels[static_cast<std::size_t>(r * samples.width + c)]);
        }
        EXPECT_EQ(around.count(all[static_cast<std::size_t>(v * 23 + u)]), 1U)
            << u << ", " << v << ", every " << every;
      }
  }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
