// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grid_problem.h"
#include "reference/inputs.h"

#include <pcl_mrf_planes/belief_gap.h>
#include <pcl_mrf_planes/label_confidence.h>
#include <pcl_mrf_planes/plane_field.h>
#include <pcl_mrf_planes/row_propagation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {
namespace {

/// Least energies of a chain with each label at each site, by going both ways.
std::vector<std::vector<std::int64_t>> minMarginals(const reference::GridProblem& chain)
{
  const int n = chain.width();
  const int labels = chain.labels();
  const auto cost = [&](int x, int y, int a, int b) {
    return chain.connected(x, 0, y, 0) ? chain.price(x, 0, y, 0, a, b) : 0;
  };
  std::vector<std::vector<std::int64_t>> best(
      static_cast<std::size_t>(n),
      std::vector<std::int64_t>(static_cast<std::size_t>(labels), 0));
  for (const bool forward : {true, false}) {
    std::vector<std::int64_t> before(static_cast<std::size_t>(labels), 0);
    for (int k = 0; k < n; ++k) {
      const int x = forward ? k : n - 1 - k;
      std::vector<std::int64_t> here;
      for (int l = 0; l < labels; ++l) {
        std::int64_t least = k == 0 ? 0 : std::numeric_limits<std::int64_t>::max();
        for (int m = 0; k > 0 && m < labels; ++m)
          least = std::min(least, before[static_cast<std::size_t>(m)] +
                                      cost(x, forward ? x - 1 : x + 1, l, m));
        here.push_back(least + chain.data(x, 0, l));
        best[static_cast<std::size_t>(x)][static_cast<std::size_t>(l)] +=
            forward ? here.back() : least;
      }
      before = here;
    }
  }
  return best;
}

TEST(BeliefGapTest, OnChainsItIsTheGapOfTheMinMarginals)
{
  scenes::Random random(3);
  for (int run = 0; run < 60; ++run) {
    const int width = random.integer(1, 12);
    const int labels = random.integer(1, 5);
    const GridField field =
        reference::randomField(random, width, 1, labels, EdgeModel::SOFT_THRESHOLD);
    BeliefPropagation propagation(field);
    propagation.iterate(2 * width + 2);
    const auto gaps = beliefGaps(field, propagation);
    ASSERT_EQ(gaps.size(), static_cast<std::size_t>(width));
    const auto exact = minMarginals(reference::GridProblem(field));
    for (std::size_t x = 0; x < gaps.size(); ++x) {
      std::vector<std::int64_t> costs = exact[x];
      std::sort(costs.begin(), costs.end());
      if (labels == 1) {
        EXPECT_EQ(gaps[x], 65535);
      }
      else {
        EXPECT_EQ(gaps[x], costs[1] - costs[0]) << "site " << x << " of run " << run;
      }
    }
  }
}

class ConfidenceTest : public testing::TestWithParam<Profile> {
protected:
  Parameters parameters_ = Parameters::fromProfile(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Profiles, ConfidenceTest,
                         testing::Values(Profile::DEFAULT, Profile::FAST,
                                         Profile::PAPER));

TEST_P(ConfidenceTest, IsAShareAndNothingForInvalidPoints)
{
  for (const auto& [width, height] :
       std::vector<std::pair<int, int>>{{1, 1}, {1, 9}, {7, 1}, {37, 29}, {160, 120}}) {
    const OrganizedPoints points = reference::toPoints(reference::takePicture(
        "room", width, height, 2, scenes::SensorNoise::kinect()));
    const auto confidence =
        labelConfidence(points, segmentPlanes(points, parameters_), parameters_);
    ASSERT_EQ(confidence.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_TRUE(confidence[i] >= 0.0f && confidence[i] <= 1.0f) << confidence[i];
      if (points.valid[i] == 0) {
        ASSERT_EQ(confidence[i], 0.0f);
      }
    }
  }
}

TEST_P(ConfidenceTest, IsLessAtACreaseThanInTheMiddleOfAWall)
{
  scenes::View view = scenes::corner();
  view.camera.resize(160, 120);
  const auto frame =
      scenes::render(view.scene, view.camera, scenes::SensorNoise::gaussian(0.005), 1);
  const OrganizedPoints points = reference::toPoints(frame);
  const PlaneSegmentation result = segmentPlanes(points, parameters_);
  ASSERT_GE(result.regions.size(), 2U);
  const auto confidence = labelConfidence(points, result, parameters_);
  double inside = 0;
  double at_border = 0;
  double inside_count = 0;
  double border_count = 0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const bool border = result.labels[i - 1] != result.labels[i] ||
                        result.labels[i + 1] != result.labels[i];
    (border ? at_border : inside) += confidence[i];
    (border ? border_count : inside_count) += 1;
  }
  EXPECT_LT(at_border / border_count, 0.9 * inside / inside_count);
}

/// Whether each valid point has the label of the true plane that most of its label's points
/// have, beside its confidence.
std::vector<std::pair<float, bool>> judge(const scenes::SceneFrame& frame,
                                          const OrganizedPoints& points,
                                          const PlaneSegmentation& result,
                                          const std::vector<float>& confidence)
{
  std::map<int, std::map<int, int>> votes;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (result.labels[i] != 0 && frame.labels[i] != 0)
      ++votes[result.labels[i]][frame.labels[i]];
  std::map<int, int> meant;
  for (const auto& [label, counts] : votes)
    meant[label] = std::max_element(
                       counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; })
                       ->first;
  std::vector<std::pair<float, bool>> judged;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      judged.emplace_back(confidence[i], meant[result.labels[i]] == frame.labels[i]);
  return judged;
}

TEST_P(ConfidenceTest, TheMoreConfidentTheMoreOftenRight)
{
  // With more noise the paper's method hardly finds planes.
  const double noise = GetParam() == Profile::PAPER ? 0.5 : 2.0;
  std::vector<std::pair<float, bool>> all;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto frame = reference::takePicture("room", 320, 240, seed,
                                              scenes::SensorNoise::kinect(noise));
    const OrganizedPoints points = reference::toPoints(frame);
    const PlaneSegmentation result = segmentPlanes(points, parameters_);
    const auto judged =
        judge(frame, points, result, labelConfidence(points, result, parameters_));
    all.insert(all.end(), judged.begin(), judged.end());
  }
  std::sort(all.begin(), all.end());
  constexpr std::size_t BINS = 5;
  std::vector<double> right(BINS, 0.0);
  for (std::size_t i = 0; i < all.size(); ++i)
    right[i * BINS / all.size()] +=
        all[i].second ? static_cast<double>(BINS) / static_cast<double>(all.size())
                      : 0.0;
  for (std::size_t k = 1; k < BINS; ++k)
    EXPECT_GT(right[k], right[k - 1] - 0.005) << "fifth " << k;
  EXPECT_LT(right.front(), 0.9);
  EXPECT_GT(right.back(), 0.97);
}

/// Points of a wall at 2 m with noise of so many metres, to the left of a column; beside them
/// points without a plane.
OrganizedPoints wallOf(int columns, double sigma)
{
  scenes::View view = scenes::singlePlane(2.0, 0.0);
  view.camera.resize(160, 120);
  const auto frame =
      scenes::render(view.scene, view.camera, scenes::SensorNoise::gaussian(sigma), 3);
  OrganizedPoints points = reference::toPoints(frame);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (static_cast<int>(i) % points.width >= columns)
      points.clear(i);
  return points;
}

/// Confidence of the point in the middle of the wall's height, a few points from its side.
float confidenceOfWall(int columns, double sigma)
{
  const OrganizedPoints points = wallOf(columns, sigma);
  Parameters parameters;
  parameters.adaptive.min_evidence = 0;
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  EXPECT_EQ(result.regions.size(), 1U);
  return labelConfidence(points, result, parameters)[60 * 160 + 4];
}

TEST(LabelConfidenceTest, PlanesWithMoreEvidenceAreSurer)
{
  const float wide = confidenceOfWall(160, 0.01);
  const float narrow = confidenceOfWall(40, 0.01);
  const float strip = confidenceOfWall(12, 0.01);
  EXPECT_GT(wide, 0.9f);
  EXPECT_GT(wide, narrow + 0.01f);
  EXPECT_GT(narrow, strip + 0.05f);
  EXPECT_GT(strip, 0.1f) << "that it is no plane is not sure either";
  EXPECT_GT(confidenceOfWall(12, 0.001), strip + 0.05f) << "less noise shows it better";
}

TEST(LabelConfidenceTest, PointsOffThePapersPlanesAreLessSure)
{
  OrganizedPoints points = wallOf(160, 0.0001);
  const std::size_t off = 60 * 160 + 80;
  const std::size_t further = 30 * 160 + 80;
  const Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  const auto depth = [](std::size_t i, float add, OrganizedPoints& moved) {
    const float f = (moved.z[i] + add) / moved.z[i];
    moved.set(i, moved.x[i] * f, moved.y[i] * f, moved.z[i] * f);
  };
  depth(off, 0.02f, points);
  depth(further, 0.2f, points);
  const PlaneSegmentation result = segmentPlanes(points, parameters);
  ASSERT_EQ(result.clusters.planes.size(), 1U);
  const auto confidence = labelConfidence(points, result, parameters);
  EXPECT_GT(confidence[off + 1], 0.99f) << "nothing competes, and it fits";
  EXPECT_LT(confidence[off], 0.9f);
  EXPECT_LT(confidence[further], 0.1f);
}

/// What a typical change of label costs: (8), or the median of (5) over the pairs.
double typicalPrice(const std::vector<Plane>& planes, const Parameters& parameters)
{
  std::vector<double> prices;
  for (std::size_t a = 0; a < planes.size(); ++a)
    for (std::size_t b = a + 1; b < planes.size(); ++b)
      prices.push_back(dissimilarity(planes[a], planes[b], parameters.beta));
  std::sort(prices.begin(), prices.end());
  return parameters.smoothness == Smoothness::POTTS ? parameters.gamma
                                                    : prices[prices.size() / 2];
}

TEST(LabelConfidenceTest, GapsOfThePapersMethodAreMeasuredInPricesOfItsSmoothness)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 320, 240, 3, scenes::SensorNoise::kinect()));
  for (const Smoothness smoothness :
       {Smoothness::POTTS, Smoothness::DISSIMILARITY, Smoothness::HYBRID}) {
    Parameters parameters = Parameters::fromProfile(Profile::PAPER);
    parameters.smoothness = smoothness;
    const PlaneSegmentation result = segmentPlanes(points, parameters);
    std::vector<Plane> planes;
    for (const PlaneModel& model : result.clusters.planes)
      planes.push_back(model.plane);
    ASSERT_GE(planes.size(), 3U);
    const PlaneField field(points, planes, parameters);
    const auto gaps = propagateRowGaps(field, parameters.iterations);
    const double unit = typicalPrice(planes, parameters) * field.unitsPerEnergy() / 2;
    const auto confidence = labelConfidence(points, result, parameters);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points.valid[i] != 0) {
        const std::uint16_t label = result.labels[i];
        ASSERT_GT(label, 0);
        const double away = result.regions[label - 1U].plane.distance(
            {points.x[i], points.y[i], points.z[i]});
        const double sigmas = away / parameters.noise.sigma(points.z[i]) / 5;
        ASSERT_NEAR(confidence[i],
                    (1 - std::exp(-gaps[i] / unit)) / (1 + sigmas * sigmas), 1e-4)
            << "smoothness " << static_cast<int>(smoothness) << ", point " << i;
      }
  }
}

} // namespace
} // namespace pcl_mrf_planes
