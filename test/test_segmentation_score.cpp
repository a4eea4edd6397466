// SPDX-License-Identifier: BSD-3-Clause
#include "reference/label_images.h"
#include "reference/segmentation_score.h"

#include <evaluation/score_summary.h>
#include <evaluation/segmentation_score.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace pcl_mrf_planes::evaluation {
namespace {

using reference::drawn;
using reference::LabelPair;
using reference::randomPair;

/// Equal within rounding, or both NaN.
void expectSame(double value, double expected, const char* name)
{
  EXPECT_EQ(std::isnan(value), std::isnan(expected)) << name << ' ' << value;
  if (!std::isnan(value) && !std::isnan(expected)) {
    EXPECT_NEAR(value, expected, 1e-9) << name;
  }
}

void expectSame(const SegmentationScore& a, const SegmentationScore& b)
{
  EXPECT_EQ(a.counts.truth, b.counts.truth);
  EXPECT_EQ(a.counts.correct, b.counts.correct);
  EXPECT_EQ(a.counts.over, b.counts.over);
  EXPECT_EQ(a.counts.under, b.counts.under);
  EXPECT_EQ(a.counts.missed, b.counts.missed);
  EXPECT_EQ(a.counts.noise, b.counts.noise);
  expectSame(a.pq, b.pq, "pq");
  expectSame(a.sc, b.sc, "sc");
  expectSame(a.ri, b.ri, "ri");
  expectSame(a.voi, b.voi, "voi");
  expectSame(a.recall, b.recall, "recall");
  expectSame(a.clutter, b.clutter, "clutter");
}

/// Other numbers for the planes of a result, in another order.
LabelImage renumbered(LabelImage image)
{
  for (std::uint16_t& label : image.labels)
    label = label == 0 ? label : static_cast<std::uint16_t>(60000 - 7 * label);
  return image;
}

TEST(SegmentationScore, PerfectResult)
{
  const LabelImage truth = drawn({"111222", "111222", "003333"});
  const SegmentationScore score = scoreLabels(truth, truth);
  EXPECT_EQ(score.counts.truth, 3);
  EXPECT_EQ(score.counts.correct, 3);
  EXPECT_EQ(score.counts.over + score.counts.under + score.counts.missed +
                score.counts.noise,
            0);
  EXPECT_EQ(score.pq, 1.0);
  EXPECT_EQ(score.sc, 1.0);
  EXPECT_EQ(score.ri, 1.0);
  EXPECT_NEAR(score.voi, 0.0, 1e-15);
  EXPECT_EQ(score.recall, 1.0);
  EXPECT_EQ(score.clutter, 0.0);
}

TEST(SegmentationScore, SplitPlaneIsOverSegmented)
{
  const LabelImage truth = drawn({"11111111", "22222222"});
  const SegmentationScore score = scoreLabels(truth, drawn({"11113333", "22222222"}));
  EXPECT_EQ(score.counts.correct, 1);
  EXPECT_EQ(score.counts.over, 1);
  EXPECT_EQ(score.counts.missed + score.counts.noise + score.counts.under, 0)
      << "the parts of a split plane have their class";
  // One match of IoU 1, a true plane and two regions without: IoU 0.5 is no match.
  EXPECT_NEAR(score.pq, 1.0 / (1.0 + 0.5 * 2 + 0.5 * 1), 1e-15);
  EXPECT_NEAR(score.sc, 0.75, 1e-15);
  EXPECT_NEAR(score.ri, 1.0 - 16.0 / 120.0, 1e-15); // 4 x 4 pairs were put apart
  EXPECT_NEAR(score.voi, 0.5 * std::log(2.0), 1e-15);
}

TEST(SegmentationScore, MergedPlanesAreUnderSegmented)
{
  const LabelImage truth = drawn({"11112222", "33333333"});
  const SegmentationScore score = scoreLabels(truth, drawn({"55555555", "33333333"}));
  EXPECT_EQ(score.counts.correct, 1);
  EXPECT_EQ(score.counts.under, 1);
  EXPECT_EQ(score.counts.missed + score.counts.noise + score.counts.over, 0)
      << "planes that were merged have their class";
  EXPECT_NEAR(score.pq, 1.0 / (1.0 + 0.5 * 1 + 0.5 * 2), 1e-15);
  EXPECT_NEAR(score.sc, 0.75, 1e-15);
  EXPECT_EQ(score.recall, 1.0);
}

TEST(SegmentationScore, SwappedRolesSwapOverAndUnder)
{
  // Without points on no plane, which count for the truth only.
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    LabelPair pair = randomPair(seed);
    for (auto* labels : {&pair.truth.labels, &pair.labels.labels})
      for (std::uint16_t& label : *labels)
        label = label == 0 || label == NOT_SCORED ? std::uint16_t{9} : label;
    const SegmentationScore a = scoreLabels(pair.truth, pair.labels);
    const SegmentationScore b = scoreLabels(pair.labels, pair.truth);
    EXPECT_EQ(a.counts.correct, b.counts.correct) << seed;
    EXPECT_NEAR(a.pq, b.pq, 1e-12) << seed;
    EXPECT_NEAR(a.ri, b.ri, 1e-12) << seed;
    EXPECT_NEAR(a.voi, b.voi, 1e-12) << seed;
  }
  const LabelImage one = drawn({"11111111"});
  const LabelImage two = drawn({"11112222"});
  EXPECT_EQ(scoreLabels(one, two).counts.over, 1);
  EXPECT_EQ(scoreLabels(two, one).counts.under, 1);
}

TEST(SegmentationScore, ToleranceDecidesWhatIsCorrect)
{
  const LabelImage truth = drawn({"1111111111"});
  const LabelImage labels = drawn({"1111111000"}); // seven of ten
  EXPECT_EQ(scoreLabels(truth, labels, {0.7, 0, true}).counts.correct, 1);
  EXPECT_EQ(scoreLabels(truth, labels, {0.71, 0, true}).counts.correct, 0);
  const auto curve = toleranceCurve(compareLabels(truth, labels), 0);
  ASSERT_EQ(curve.size(), 10u);
  for (const CurvePoint& point : curve)
    EXPECT_EQ(point.counts.correct, point.tolerance < 0.705 ? 1 : 0) << point.tolerance;
}

TEST(SegmentationScore, PlanesWithFewPointsAreLeftOut)
{
  const LabelImage truth = drawn({"11111122"});
  const LabelImage labels = drawn({"11111134"});
  const SegmentationScore score = scoreLabels(truth, labels, {0.8, 2, true});
  EXPECT_EQ(score.counts.truth, 1);
  EXPECT_EQ(score.counts.noise + score.counts.missed, 0);
  EXPECT_EQ(score.pq, 1.0);
  EXPECT_EQ(score.sc, 1.0);
  EXPECT_LT(score.ri, 1.0) << "the Rand index knows no regions to leave out";
}

TEST(SegmentationScore, PointsThatAreNotScoredDoNotCount)
{
  const LabelImage truth = drawn({"1111xxxx"});
  const SegmentationScore score = scoreLabels(truth, drawn({"11112233"}));
  EXPECT_EQ(score.counts.correct, 1);
  EXPECT_EQ(score.counts.noise, 0);
  EXPECT_EQ(score.pq, 1.0);
  EXPECT_TRUE(std::isnan(score.clutter)) << "no point off the planes is scored";
}

TEST(SegmentationScore, RegionsMostlyOnPointsThatAreNotScoredAreNotJudged)
{
  // Region 2 has one of three points where the truth scores; region 3 half of them.
  const LabelImage truth = drawn({"11111xx00xx1"});
  const SegmentationScore score = scoreLabels(truth, drawn({"111112220333"}));
  EXPECT_EQ(score.counts.noise, 0);
  const LabelImage half = drawn({"111112203300"});
  EXPECT_EQ(scoreLabels(drawn({"11111x000x00"}), half).counts.noise, 2)
      << "half of its points are enough to judge a region";
}

TEST(SegmentationScore, RegionsOffTheTruePlanesAreClutterNotWrongPlanes)
{
  const LabelImage truth = drawn({"11110000"});
  const SegmentationScore score = scoreLabels(truth, drawn({"11112220"}));
  EXPECT_EQ(score.pq, 1.0) << "region 2 lies where the truth has no plane";
  EXPECT_EQ(score.counts.noise, 1);
  EXPECT_EQ(score.clutter, 0.75);
  EXPECT_TRUE(std::isnan(scoreLabels(truth, truth, {0.8, 0, false}).clutter))
      << "a truth that lacks planes cannot tell clutter";
  const SegmentationScore wider = scoreLabels(truth, drawn({"11111110"}));
  EXPECT_EQ(wider.pq, 1.0) << "points on no plane are not part of the union";
}

TEST(SegmentationScore, NothingToMeasure)
{
  for (const LabelImage& truth : {LabelImage{}, drawn({"0000"}), drawn({"xxxx"})}) {
    LabelImage labels = truth;
    labels.labels.assign(truth.size(), 0);
    const SegmentationScore score = scoreLabels(truth, labels);
    EXPECT_EQ(score.counts.truth, 0);
    EXPECT_EQ(score.pq, 1.0);
    EXPECT_EQ(score.sc, 1.0);
    EXPECT_TRUE(std::isnan(score.ri));
    EXPECT_TRUE(std::isnan(score.voi));
    EXPECT_TRUE(std::isnan(score.recall));
  }
  EXPECT_EQ(scoreLabels(drawn({"1"}), drawn({"0"})).ri, 1.0) << "no pairs of points";
  EXPECT_EQ(scoreLabels(drawn({"1"}), drawn({"0"})).pq, 0.0);
}

TEST(SegmentationScore, NumbersOfTheLabelsDoNotMatter)
{
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const LabelPair pair = randomPair(seed);
    expectSame(scoreLabels(pair.truth, renumbered(pair.labels)),
               scoreLabels(pair.truth, pair.labels));
  }
}

TEST(SegmentationScore, AgreesWithTheDefinitions)
{
  int over = 0, under = 0, noise = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    const LabelPair pair = randomPair(seed);
    const double tolerance = std::vector<double>{0.51, 0.6, 0.8, 1.0}[seed % 4];
    const auto min_points = static_cast<std::size_t>(seed % 3 == 0 ? 5 : 0);
    const SegmentationScore score = scoreLabels(
        pair.truth, pair.labels, {tolerance, static_cast<int>(min_points), true});
    const reference::ScoredImages images(pair.truth.labels, pair.labels.labels);
    const auto counts = reference::hoover(images, tolerance, min_points);
    SegmentationScore expected;
    expected.counts = {counts.truth, counts.correct, counts.over,
                       counts.under, counts.missed,  counts.noise};
    expected.pq = reference::panopticQuality(images, min_points);
    expected.sc = reference::covering(images, min_points);
    expected.ri = reference::randIndex(images);
    expected.voi = reference::variationOfInformation(images);
    expected.recall = reference::shareLabelled(images, true);
    expected.clutter = reference::shareLabelled(images, false);
    expectSame(score, expected);
    over += counts.over;
    under += counts.under;
    noise += counts.noise;
  }
  EXPECT_GT(over, 10) << "the images show too few of this class";
  EXPECT_GT(under, 10) << "the images show too few of this class";
  EXPECT_GT(noise, 10) << "the images show too few of this class";
}

TEST(SegmentationScore, RefusesWhatCannotBeCompared)
{
  EXPECT_THROW(scoreLabels(drawn({"11"}), drawn({"1", "1"})), std::invalid_argument);
  LabelImage short_one = drawn({"1111"});
  short_one.labels.pop_back();
  EXPECT_THROW(scoreLabels(short_one, short_one), std::invalid_argument);
  const LabelImage any = drawn({"11"});
  for (const double tolerance : {0.5, 1.01, -1.0, std::nan("")})
    EXPECT_THROW(scoreLabels(any, any, {tolerance, 0, true}), std::invalid_argument);
  EXPECT_THROW(scoreLabels(any, any, {0.8, -1, true}), std::invalid_argument);
}

TEST(ScoreSummary, MeansLeaveOutWhatIsNotThere)
{
  SegmentationScore a, b;
  a.counts = {10, 5, 0, 0, 5, 0};
  a.pq = 0.5;
  a.clutter = 0.25;
  b.counts = {2, 2, 0, 0, 0, 1};
  b.pq = 1.0;
  const ScoreSummary summary = summarize(std::vector<SegmentationScore>{a, b});
  EXPECT_EQ(summary.frames, 2);
  EXPECT_EQ(summary.truth, 6.0);
  EXPECT_NEAR(summary.ratio, 7.0 / 12.0, 1e-15) << "planes count, not frames";
  EXPECT_EQ(summary.pq, 0.75);
  EXPECT_EQ(summary.clutter, 0.25) << "one frame has none";
  EXPECT_TRUE(std::isnan(summary.ri));
  const ScoreSummary sets =
      meanOfSets({summary, summarize(std::vector<SegmentationScore>{b})});
  EXPECT_EQ(sets.frames, 3);
  EXPECT_NEAR(sets.pq, 0.875, 1e-15);
  EXPECT_NEAR(sets.ratio, 0.5 * (7.0 / 12.0 + 1.0), 1e-15);
  EXPECT_TRUE(std::isnan(summarize({}).pq));
}

} // namespace
} // namespace pcl_mrf_planes::evaluation
