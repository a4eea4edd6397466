// SPDX-License-Identifier: BSD-3-Clause
#include "reference/ray_images.h"

#include <pcl_mrf_planes/region_contour.h>
#include <pcl_mrf_planes/region_parts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pcl_mrf_planes {
namespace {

TEST(RegionPartsTest, PartsAreTheConnectedPatchesOfTheRegions)
{
  scenes::Random random(4);
  for (int run = 0; run < 40; ++run) {
    const auto input = reference::raggedPoints(random, run % 2 == 1);
    const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
    const auto parts = separateParts(input.points, regions);
    const auto expected = findConnectedParts(regionLabels(input.points, regions),
                                             input.points.width, input.points.height);
    ASSERT_EQ(parts.size(), expected.size.size());
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const PlaneRegion& part = parts[k];
      const int number =
          expected.part_of_point[static_cast<std::size_t>(part.indices.front())];
      ASSERT_EQ(static_cast<int>(part.indices.size()),
                expected.size[static_cast<std::size_t>(number)]);
      for (const int i : part.indices)
        ASSERT_EQ(expected.part_of_point[static_cast<std::size_t>(i)], number);
      const auto region = static_cast<std::size_t>(part.label);
      EXPECT_EQ(region + 1, expected.label[static_cast<std::size_t>(number)]);
      EXPECT_EQ(part.plane.d, regions[region].plane.d) << "the plane is the region's";
      if (k > 0) {
        EXPECT_LE(part.area, parts[k - 1].area) << "largest area first";
      }
    }
  }
}

TEST(RegionPartsTest, AreasAddUp)
{
  scenes::Random random(5);
  const auto input = reference::raggedPoints(random, false);
  const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
  std::vector<double> sum(regions.size(), 0.0);
  for (const PlaneRegion& part : separateParts(input.points, regions))
    sum[static_cast<std::size_t>(part.label)] += part.area;
  for (std::size_t k = 0; k < regions.size(); ++k)
    // Faces between parts that meet at corners belong to none of them.
    EXPECT_LE(sum[k], regions[k].area + 1e-9);
}

TEST(RegionPartsTest, SmallOnesAreDroppedByPointsOrByArea)
{
  // Two squares of 3x3 and 2x2 points, a metre apart from point to point.
  OrganizedPoints points;
  points.resize(6, 3);
  std::vector<std::uint16_t> labels(18, NO_PLANE);
  for (std::size_t i = 0; i < 18; ++i) {
    const std::size_t x = i % 6;
    const std::size_t y = i / 6;
    points.set(i, static_cast<float>(x), static_cast<float>(y), 5.0f);
    if (x < 3 || (x > 3 && y < 2))
      labels[i] = 0;
  }
  const std::vector<Plane> planes = {{{0, 0, -1}, 5}};
  const auto regions = gatherRegions(points, planes, labels, 0);
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(separateParts(points, regions).size(), 2U);
  EXPECT_EQ(separateParts(points, regions, 4).size(), 2U);
  EXPECT_EQ(separateParts(points, regions, 5).size(), 1U)
      << "4 points are fewer than 5";
  EXPECT_EQ(separateParts(points, regions, 1, 1.5).size(), 1U) << "1 square metre";
  EXPECT_TRUE(separateParts(points, regions, 1, 4.5).empty());
  EXPECT_TRUE(separateParts(points, {}).empty());
}

// Labels of parts are 16-bit numbers: of more parts than these the largest stay.
TEST(RegionPartsTest, OfTooManyPartsTheLargestAreKept)
{
  constexpr int SIDE = 524; // every other point both ways: 68644 that touch no other
  constexpr int JOINED = 500;
  constexpr std::size_t MOST = 65000;
  OrganizedPoints points;
  points.resize(SIDE, SIDE);
  std::vector<std::uint16_t> labels(points.size(), NO_PLANE);
  std::ptrdiff_t larger = 0;
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x) {
      const auto i = static_cast<std::size_t>(y * SIDE + x);
      points.set(i, 0.01f * static_cast<float>(x), 0.01f * static_cast<float>(y), 3.0f);
      // Near the end of the image some points join those above and below.
      const bool joins = y > JOINED && x % 4 == 0 && y % 4 == 1;
      if (joins || (x % 2 == 0 && y % 2 == 0))
        labels[i] = 0;
      larger += joins ? 1 : 0;
    }
  const std::vector<Plane> planes = {{{0, 0, -1}, 3}};
  const auto regions = gatherRegions(points, planes, labels, 0);
  ASSERT_EQ(regions.size(), 1U);
  const auto parts = separateParts(points, regions, 1);
  EXPECT_EQ(parts.size(), MOST);
  EXPECT_EQ(std::count_if(parts.begin(), parts.end(),
                          [](const auto& part) { return part.indices.size() > 1; }),
            larger)
      << "none of the larger parts, last in the image, may go";
}

} // namespace
} // namespace pcl_mrf_planes
