// SPDX-License-Identifier: BSD-3-Clause
//
// Points off the borders of regions, beside plain loops over pixels.
#include "region_interior.h"
#include "scenes/random.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {
namespace {

/// Points at random places with labels in patches, and some that were not measured.
struct LabelImage {
  OrganizedPoints points;
  std::vector<std::uint16_t> labels; ///< 0: none, 1 to 3

  LabelImage(scenes::Random& random, int width, int height, int dropouts)
  {
    points.resize(width, height);
    labels.assign(points.size(), 0);
    for (std::size_t i = 0; i < points.size(); ++i)
      points.set(i, static_cast<float>(random.normal()),
                 static_cast<float>(random.normal()),
                 static_cast<float>(3 + random.normal()));
    for (int patch = 0; patch < 12; ++patch)
      fill(random);
    for (int k = 0; k < dropouts; ++k)
      drop(static_cast<std::size_t>(
          random.integer(0, static_cast<int>(points.size()) - 1)));
  }

  void fill(scenes::Random& random)
  {
    const int left = random.integer(0, points.width - 1);
    const int top = random.integer(0, points.height - 1);
    const int right = random.integer(left, points.width - 1);
    const int bottom = random.integer(top, points.height - 1);
    const auto label = static_cast<std::uint16_t>(random.integer(0, 3));
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x)
        labels[static_cast<std::size_t>(y * points.width + x)] = label;
  }

  void drop(std::size_t i)
  {
    points.clear(i);
    labels[i] = 0;
  }

  std::vector<PlaneRegion> regions() const
  {
    std::vector<PlaneRegion> out(3);
    for (std::size_t k = 0; k < out.size(); ++k) {
      ScatterMatrix sums;
      for (std::size_t i = 0; i < labels.size(); ++i)
        if (labels[i] == k + 1) {
          out[k].indices.push_back(static_cast<int>(i));
          sums.add(points.x[i], points.y[i], points.z[i]);
        }
      out[k].centroid = sums.n > 0 ? sums.centroid() : Eigen::Vector3d::Zero();
      out[k].covariance = sums.n > 0 ? sums.covariance() : Eigen::Matrix3d::Zero();
    }
    return out;
  }
};

/// The labels with gaps of up to four unmeasured points of a row closed.
std::vector<std::uint16_t> closed(const LabelImage& image)
{
  std::vector<std::uint16_t> labels = image.labels;
  const int width = image.points.width;
  for (int y = 0; y < image.points.height; ++y)
    for (int x = 1, gap = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      gap = image.points.valid[i] == 0 ? gap + 1 : 0;
      const bool ends = x + 1 < width && image.points.valid[i + 1] != 0;
      const int before = x - gap;
      if (gap == 0 || gap > 4 || !ends || before < 0)
        continue;
      const std::uint16_t label = labels[i + 1];
      if (label != 0 &&
          image.labels[static_cast<std::size_t>(y * width + before)] == label)
        for (int k = 0; k < gap; ++k)
          labels[i - static_cast<std::size_t>(k)] = label;
    }
  return labels;
}

bool isInside(const LabelImage& image, const std::vector<std::uint16_t>& labels, int x,
              int y)
{
  const int width = image.points.width;
  const std::uint16_t label = image.labels[static_cast<std::size_t>(y * width + x)];
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if (u >= 0 && v >= 0 && u < width && v < image.points.height &&
          labels[static_cast<std::size_t>(v * width + u)] != label)
        return false;
  return label != 0;
}

TEST(RegionInteriorTest, HoldsThePointsWithoutOtherNeighbours)
{
  scenes::Random random(11);
  int inside_count = 0;
  for (int run = 0; run < 200; ++run) {
    const LabelImage image(random, random.integer(1, 40), random.integer(1, 30),
                           random.integer(0, 20));
    const std::vector<std::uint16_t> labels = closed(image);
    const auto found = regionInteriors(image.points, image.regions());
    ASSERT_EQ(found.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) {
      std::vector<std::size_t> expected;
      ScatterMatrix sums;
      for (std::size_t i = 0; i < labels.size(); ++i) {
        const int at = static_cast<int>(i);
        if (image.labels[i] == k + 1 &&
            isInside(image, labels, at % image.points.width, at / image.points.width)) {
          expected.push_back(i);
          sums.add(image.points.x[i], image.points.y[i], image.points.z[i]);
        }
      }
      std::vector<std::size_t> inside;
      for (const LabelRun& r : found[k].runs)
        for (std::size_t i = r.begin; i < r.end; ++i)
          inside.push_back(i);
      ASSERT_EQ(inside, expected) << "region " << k << " of run " << run;
      ASSERT_EQ(found[k].n, sums.n);
      inside_count += static_cast<int>(sums.n);
      if (sums.n == 0)
        continue;
      ASSERT_LT((found[k].centroid - sums.centroid()).norm(), 1e-9);
      ASSERT_LT((found[k].covariance - sums.covariance()).norm(), 1e-8);
    }
  }
  EXPECT_GT(inside_count, 5000);
}

TEST(RegionInteriorTest, NoRegionsHaveNone)
{
  OrganizedPoints points;
  EXPECT_TRUE(regionInteriors(points, {}).empty());
  points.resize(3, 2);
  EXPECT_TRUE(regionInteriors(points, {}).empty());
}

} // namespace
} // namespace pcl_mrf_planes
