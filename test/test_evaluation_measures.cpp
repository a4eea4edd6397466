// SPDX-License-Identifier: BSD-3-Clause
// Borders, and planes of regions that match.
#include "reference/borders.h"
#include "reference/label_images.h"

#include <evaluation/border_agreement.h>
#include <evaluation/plane_errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace pcl_mrf_planes::evaluation {
namespace {

using reference::drawn;
using reference::randomPair;

TEST(BorderAgreement, PerfectResult)
{
  const LabelImage truth = drawn({"1122", "1122", "3333"});
  const BorderAgreement border = compareBorders(truth, truth, 0);
  EXPECT_EQ(border.truth_points, 4 + 4 + 2)
      << "both sides of a border; not the corners";
  EXPECT_EQ(border.precision(), 1.0);
  EXPECT_EQ(border.recall(), 1.0);
  EXPECT_EQ(border.f(), 1.0);
}

TEST(BorderAgreement, ShiftedBorderIsFoundFromItsDistanceOn)
{
  const LabelImage truth = drawn({"1111122222", "1111122222"});
  const LabelImage labels = drawn({"1111111122", "1111111122"}); // three to the right
  for (const int distance : {0, 1, 2, 3, 4, 1000}) {
    const BorderAgreement border = compareBorders(truth, labels, distance);
    const double expected = distance >= 3 ? 1.0 : distance == 2 ? 0.5 : 0.0;
    EXPECT_EQ(border.precision(), expected) << distance;
    EXPECT_EQ(border.recall(), expected) << distance;
    EXPECT_EQ(border.f(), expected) << distance;
  }
}

TEST(BorderAgreement, PointsThatAreNotScoredHaveNoBorder)
{
  const LabelImage truth = drawn({"111xx222"});
  const BorderAgreement border = compareBorders(truth, drawn({"11112223"}), 1);
  EXPECT_EQ(border.truth_points, 0);
  EXPECT_EQ(border.label_points, 2) << "between 2 and 3; that in the gap is not scored";
  EXPECT_TRUE(std::isnan(border.precision()));
  EXPECT_TRUE(std::isnan(border.recall()));
  EXPECT_TRUE(std::isnan(border.f()));
}

TEST(BorderAgreement, ResultWithoutBordersFindsNone)
{
  const BorderAgreement border = compareBorders(drawn({"1122"}), drawn({"0000"}), 1);
  EXPECT_TRUE(std::isnan(border.precision()));
  EXPECT_EQ(border.recall(), 0.0);
  EXPECT_EQ(border.f(), 0.0);
}

TEST(BorderAgreement, AgreesWithTheDefinition)
{
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE(seed);
    const auto [truth, labels] = randomPair(seed, 14);
    const int distance = static_cast<int>(seed % 5);
    const BorderAgreement border = compareBorders(truth, labels, distance);
    const double recall = reference::borderShare(
        truth.labels, labels.labels, truth.labels, truth.width, truth.height, distance);
    const double precision = reference::borderShare(
        labels.labels, truth.labels, truth.labels, truth.width, truth.height, distance);
    EXPECT_EQ(std::isnan(border.recall()), std::isnan(recall));
    EXPECT_EQ(std::isnan(border.precision()),
              std::isnan(precision) || std::isnan(recall));
    if (!std::isnan(border.recall())) {
      EXPECT_NEAR(border.recall(), recall, 1e-12);
    }
    if (!std::isnan(border.precision())) {
      EXPECT_NEAR(border.precision(), precision, 1e-12);
    }
  }
}

TEST(BorderAgreement, RefusesWhatCannotBeCompared)
{
  EXPECT_THROW(compareBorders(drawn({"11"}), drawn({"1"}), 1), std::invalid_argument);
  EXPECT_THROW(compareBorders(drawn({"11"}), drawn({"11"}), -1), std::invalid_argument);
}

/// A wall two metres away in the left half, tilted by \a degrees in the other.
OrganizedPoints tiltedHalves(int width, int height, double degrees)
{
  const double slope = std::tan(degrees * 3.14159265358979323846 / 180.0);
  OrganizedPoints points;
  points.resize(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double u = 0.01 * x;
      const double past = std::max(0.0, u - 0.01 * (width / 2));
      points.set(static_cast<std::size_t>(y * width + x), static_cast<float>(u),
                 0.01f * static_cast<float>(y), static_cast<float>(2.0 + slope * past));
    }
  return points;
}

TEST(PlaneErrors, ExactRegionsHaveNone)
{
  const OrganizedPoints points = tiltedHalves(8, 3, 30.0);
  const LabelImage truth = drawn({"11112222", "11112222", "11112222"});
  const auto errors = planeErrors(points, truth, truth);
  ASSERT_EQ(errors.size(), 2u);
  for (const PlaneError& error : errors) {
    EXPECT_EQ(error.truth, error.label);
    EXPECT_NEAR(error.angle, 0.0, 1e-4);
    EXPECT_NEAR(error.offset, 0.0, 1e-7);
  }
}

TEST(PlaneErrors, PlaneOfARegionThatReachesTooFar)
{
  // The result's region 5 is true plane 1 with points one metre behind it, all of which
  // are not scored: its plane is the mean, a third of a metre off, and parallel.
  OrganizedPoints points;
  points.resize(3, 4);
  for (int i = 0; i < 12; ++i)
    points.set(static_cast<std::size_t>(i), static_cast<float>(i % 2),
               static_cast<float>(i / 2 % 2), i < 8 ? 2.0f : 3.0f);
  const LabelImage truth = drawn({"111", "111", "11x", "xxx"});
  const LabelImage labels = drawn({"555", "555", "555", "555"});
  const auto errors = planeErrors(points, truth, labels);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].label, 5);
  EXPECT_NEAR(errors[0].angle, 0.0, 1e-6);
  EXPECT_NEAR(errors[0].offset, 1.0 / 3.0, 1e-6);
}

TEST(PlaneErrors, AngleOfAKnownTilt)
{
  // The valid points of the result's region all lie on the tilted half, those of the
  // true region on the wall: labels say that they match, points that they differ.
  for (const double degrees : {0.01, 1.0, 45.0, 80.0}) {
    OrganizedPoints points = tiltedHalves(40, 5, degrees);
    LabelImage truth = {40, 5, {}}, labels = {40, 5, {}};
    for (int i = 0; i < 200; ++i) {
      const int x = i % 40;
      if (x >= 4 && x < 20)
        points.clear(static_cast<std::size_t>(i));
      truth.labels.push_back(x < 20 ? 1 : NOT_SCORED);
      labels.labels.push_back(x < 4 ? 0 : x < 36 ? 7 : 0);
    }
    const auto errors = planeErrors(points, truth, labels);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].label, 7);
    EXPECT_NEAR(errors[0].angle, degrees, 1e-3);
    // Its line through the wall's edge at x = 0.20, seen from x = 0.015 on the wall.
    const double radians = degrees * 3.14159265358979323846 / 180.0;
    EXPECT_NEAR(errors[0].offset, 0.185 * std::sin(radians), 1e-5);
  }
}

TEST(PlaneErrors, RegionsWithoutAPlaneAreLeftOut)
{
  OrganizedPoints points = tiltedHalves(8, 3, 30.0);
  const LabelImage truth = drawn({"11112222", "11112222", "11112222"});
  for (std::size_t i = 0; i < points.size(); ++i)
    if (truth.labels[i] == 2)
      points.clear(i);
  EXPECT_EQ(planeErrors(points, truth, truth).size(), 1u);
  const LabelImage nothing = drawn({"00000000", "00000000", "00000000"});
  EXPECT_TRUE(planeErrors(points, truth, nothing).empty());
  EXPECT_THROW(planeErrors(OrganizedPoints(), truth, truth), std::invalid_argument);
}

TEST(PlaneErrors, Summary)
{
  const PlaneErrorSummary summary =
      summarize(std::vector<PlaneError>{{1, 1, 1.0, 0.1}, {2, 2, 4.0, 0.3}});
  EXPECT_EQ(summary.planes, 2);
  EXPECT_EQ(summary.angle.mean, 2.5);
  EXPECT_EQ(summary.angle.median, 2.5);
  EXPECT_EQ(summary.angle.most, 4.0);
  EXPECT_NEAR(summary.offset.mean, 0.2, 1e-15);
  EXPECT_EQ(spreadOf({5.0, 1.0, 2.0}).median, 2.0);
  EXPECT_TRUE(std::isnan(summarize(std::vector<PlaneError>{}).angle.mean));
}

} // namespace
} // namespace pcl_mrf_planes::evaluation
