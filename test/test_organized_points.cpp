// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/organized_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_mrf_planes {
namespace {

TEST(OrganizedPointsTest, WhatIsNotFiniteOrAbsurdlyFarIsInvalid)
{
  constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
  constexpr float ENDLESS = std::numeric_limits<float>::infinity();
  OrganizedPoints points;
  points.resize(3, 1);
  EXPECT_EQ(points.countValid(), 0U) << "a new image has measured nothing";
  for (const float bad : {NOT_A_NUMBER, ENDLESS, -ENDLESS, 1.1e6f, -1.1e6f})
    for (int axis = 0; axis < 3; ++axis) {
      float p[3] = {1, 2, 3};
      p[axis] = bad;
      points.set(1, p[0], p[1], p[2]);
      EXPECT_EQ(points.valid[1], 0) << bad << " on axis " << axis << " was taken";
      EXPECT_EQ(points.x[1] + points.y[1] + points.z[1], 0.0f)
          << "an invalid point must add nothing to a sum";
    }
  points.set(0, 1, 2, 3);
  points.set(2, -1e6f, 1e6f, 0);
  EXPECT_EQ(points.countValid(), 2U);
  points.clear(0);
  EXPECT_EQ(points.countValid(), 1U);
  EXPECT_EQ(points.x[0], 0.0f);
  points.resize(5, 4);
  EXPECT_EQ(points.size(), 20U);
  EXPECT_EQ(points.countValid(), 0U) << "another size must forget the points";
}

TEST(OrganizedPointsTest, LoadedPointsAreThoseSetOneByOne)
{
  scenes::Random random(5);
  constexpr float BAD[] = {std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity(), -2e6f, 1e30f};
  for (const std::size_t stride : {3U, 4U, 5U, 8U, 12U})
    for (const int width : {1, 2, 3, 4, 5, 7, 8, 33}) {
      const int height = 3;
      const auto count = static_cast<std::size_t>(width * height);
      // Not a number more than the last point has: reading on would be noticed.
      std::vector<float> numbers((count - 1) * stride + 3, BAD[0]);
      OrganizedPoints expected;
      expected.resize(width, height);
      for (std::size_t i = 0; i < count; ++i) {
        float* p = &numbers[i * stride];
        for (int axis = 0; axis < 3; ++axis)
          p[axis] = random.chance(0.1) ? BAD[random.integer(0, 3)]
                                       : static_cast<float>(random.uniform(-1e6, 1e6));
        expected.set(i, p[0], p[1], p[2]);
      }
      OrganizedPoints points;
      points.resize(50, 50); // whatever was there before
      points.load(width, height, numbers.data(), stride);
      EXPECT_EQ(points.width, width);
      EXPECT_EQ(points.height, height);
      EXPECT_EQ(points.x, expected.x) << count << " points, stride " << stride;
      EXPECT_EQ(points.y, expected.y) << count << " points, stride " << stride;
      EXPECT_EQ(points.z, expected.z) << count << " points, stride " << stride;
      EXPECT_EQ(points.valid, expected.valid) << count << " points, stride " << stride;
    }
}

TEST(OrganizedPointsTest, ValidPointsAreCounted)
{
  scenes::Random random(6);
  for (const int count : {1, 7, 8, 9, 2039, 2040, 2041, 5000})
    for (const double share : {0.0, 0.5, 1.0}) {
      const OrganizedPoints points = reference::randomPoints(random, count, 1, share);
      std::size_t expected = 0;
      for (const int is_valid : points.valid)
        expected += is_valid != 0 ? 1U : 0U;
      EXPECT_EQ(points.countValid(), expected) << count << " points";
    }
}

TEST(OrganizedPointsTest, DepthIsZOrRange)
{
  OrganizedPoints points;
  points.resize(2, 2);
  for (std::size_t i = 0; i < 4; ++i)
    points.set(i, static_cast<float>(i), 4.0f, 3.0f);
  std::vector<float> storage;
  points.resolveDepthMeasure(DepthMeasure::OPTICAL_AXIS);
  EXPECT_EQ(points.depth(0), 3.0f);
  EXPECT_EQ(points.depthRow(1, storage)[1], 3.0f);
  points.resolveDepthMeasure(DepthMeasure::RANGE);
  EXPECT_FLOAT_EQ(points.depth(0), 5.0f);
  for (int x = 0; x < 2; ++x)
    EXPECT_EQ(points.depthRow(1, storage)[x],
              points.depth(static_cast<std::size_t>(2 + x)))
        << "a row of depths must be the depths of the row";
  EXPECT_DOUBLE_EQ(points.depthOf({0, 3, -4}), 5.0);
}

TEST(OrganizedPointsTest, AutoTakesTheRangeWhenOnePercentLiesBehind)
{
  for (const int behind : {0, 1, 2, 50}) {
    OrganizedPoints points;
    points.resize(120, 9); // 100 of a row valid
    for (int y = 0; y < points.height; ++y)
      for (int x = 0; x < 100; ++x)
        points.set(static_cast<std::size_t>(y * points.width + x), 1.0f, 0.0f,
                   y % 4 == 0 && x < behind ? -2.0f : 2.0f);
    points.resolveDepthMeasure(DepthMeasure::AUTO);
    EXPECT_EQ(points.depth_measure,
              behind > 1 ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS)
        << behind << " of 100 points of each fourth row lie behind the sensor";
  }
  OrganizedPoints nothing;
  nothing.resize(3, 3);
  nothing.resolveDepthMeasure(DepthMeasure::AUTO);
  EXPECT_NE(nothing.depth_measure, DepthMeasure::AUTO) << "AUTO must be resolved";
}

} // namespace
} // namespace pcl_mrf_planes
