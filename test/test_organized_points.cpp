// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"

#include <pcl_mrf_planes/organized_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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
    points.resize(10, 12); // 100 valid
    for (int i = 0; i < 100; ++i)
      points.set(static_cast<std::size_t>(i), 1.0f, 0.0f, i < behind ? -2.0f : 2.0f);
    points.resolveDepthMeasure(DepthMeasure::AUTO);
    EXPECT_EQ(points.depth_measure,
              behind > 1 ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS)
        << behind << " of 100 points lie behind the sensor";
  }
  OrganizedPoints nothing;
  nothing.resize(3, 3);
  nothing.resolveDepthMeasure(DepthMeasure::AUTO);
  EXPECT_NE(nothing.depth_measure, DepthMeasure::AUTO) << "AUTO must be resolved";
}

} // namespace
} // namespace pcl_mrf_planes
