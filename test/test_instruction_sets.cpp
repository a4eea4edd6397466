// SPDX-License-Identifier: BSD-3-Clause
//
// The kernels run on whatever instruction set the machine has; all must give the same.
#include "reference/inputs.h"

#include "adaptive/local_noise_kernel.h"
#include "field_kernel.h"
#include "label_runs_kernel.h"

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <cmath>
#include <limits>

namespace pcl_mrf_planes {
namespace {

/// Calls work() once for each instruction set that this machine and the library have.
template <typename Work>
int forEachInstructionSet(const Work& work)
{
  int tried = 0;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    work(hwy::TargetName(target));
    ++tried;
  }
  hwy::SetSupportedTargetsForTest(0);
  return tried;
}

TEST(InstructionSetTest, PropagationGivesTheSameLabels)
{
  for (const EdgeModel model : {EdgeModel::SOFT_THRESHOLD, EdgeModel::SCALED_MAXIMUM}) {
    scenes::Random random(3);
    const GridField field = reference::randomField(random, 133, 37, 7, model);
    BeliefPropagation best(field);
    best.iterate(6);
    const auto expected = best.mapLabels();
    const int tried = forEachInstructionSet([&](const char* name) {
      BeliefPropagation propagation(field);
      propagation.iterate(6);
      EXPECT_EQ(propagation.mapLabels(), expected) << "other labels on " << name;
      EXPECT_EQ(propagateRows(field, 6), expected) << "other labels on " << name;
    });
    EXPECT_GE(tried, 1);
    RecordProperty("instruction_sets", tried);
  }
}

TEST(InstructionSetTest, ChangesOfLabelsAreFoundWhereTheyAre)
{
  constexpr std::uint32_t UNTOUCHED = 4711;
  scenes::Random random(11);
  for (std::size_t count = 1; count < 200; count += count < 70 ? 1 : 43)
    for (const double share : {0.0, 0.1, 1.0}) {
      std::vector<std::uint16_t> labels(count, 9);
      for (std::size_t k = 1; k < count; ++k)
        labels[k] = random.uniform() < share
                        ? static_cast<std::uint16_t>(random.integer(0, 65535))
                        : labels[k - 1];
      std::vector<std::uint32_t> expected;
      for (std::size_t k = 1; k < count; ++k)
        if (labels[k] != labels[k - 1])
          expected.push_back(static_cast<std::uint32_t>(k));
      forEachInstructionSet([&](const char* name) {
        std::vector<std::uint32_t> places(count, UNTOUCHED);
        const std::size_t found = findChanges(labels.data(), count, places.data());
        ASSERT_LT(found, count) << "no room for the last on " << name;
        EXPECT_EQ(places[count - 1], UNTOUCHED)
            << "written behind the room on " << name;
        places.resize(found);
        EXPECT_EQ(places, expected) << count << " labels on " << name;
      });
    }
}

/// Costs of a row, at an odd address and with something behind that must survive.
std::vector<std::uint16_t> dataTerms(const DataTerm& term, const OrganizedPoints& p,
                                     std::size_t start, std::size_t count)
{
  std::vector<std::uint16_t> costs(count + 8, 4711);
  dataTermRow(term, &p.x[start], &p.y[start], &p.z[start], &p.valid[start], count,
              costs.data());
  return costs;
}

std::vector<std::uint16_t> edgeWeights(float scale, const OrganizedPoints& p,
                                       std::size_t start, std::size_t count)
{
  std::vector<std::uint16_t> weights(count + 8, 4711);
  edgeWeightRow(&p.z[start], &p.z[start + 1], &p.valid[start], &p.valid[start + 1],
                scale, count, weights.data());
  return weights;
}

TEST(InstructionSetTest, FieldRowsAreTheSameBitsAndStayInTheirRow)
{
  scenes::Random random(4);
  const OrganizedPoints points = reference::randomPoints(random, 400, 1);
  const DataTerm term = {0.6f, -0.48f, 0.64f, 1.25f, 0.5f, 20000.0f};
  for (const std::size_t count : {1U, 2U, 7U, 8U, 15U, 16U, 17U, 33U, 64U, 301U}) {
    const std::size_t start = count % 5;
    const auto data = dataTerms(term, points, start, count);
    const auto weights = edgeWeights(30000.0f, points, start, count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = start + k;
      const float r = (term.a * points.x[i] + term.b * points.y[i]) +
                      (term.c * points.z[i] + term.d);
      const float cost = std::nearbyint(std::min(std::abs(r), term.tau) * term.scale);
      EXPECT_EQ(data[k], points.valid[i] != 0 ? static_cast<int>(cost) : 0)
          << "not the rounded data term (7), point " << k << " of " << count;
      const float step = std::abs(points.z[i] - points.z[i + 1]) * 30000.0f;
      const bool edge = points.valid[i] != 0 && points.valid[i + 1] != 0;
      EXPECT_EQ(weights[k],
                edge ? static_cast<int>(std::nearbyint(std::min(step, 65534.0f)))
                     : 65535)
          << "not the rounded depth step, point " << k << " of " << count;
    }
    for (std::size_t k = count; k < count + 8; ++k) {
      EXPECT_EQ(data[k], 4711) << "wrote beyond " << count << " points";
      EXPECT_EQ(weights[k], 4711) << "wrote beyond " << count << " points";
    }
    forEachInstructionSet([&](const char* name) {
      EXPECT_EQ(dataTerms(term, points, start, count), data)
          << "other costs on " << name;
      EXPECT_EQ(edgeWeights(30000.0f, points, start, count), weights)
          << "other weights on " << name;
    });
  }
}

/// Points in no order, some of them not measured.
std::vector<float> scattered(std::size_t count)
{
  scenes::Random random(6);
  std::vector<float> numbers;
  for (std::size_t i = 0; i < 4 * count; ++i)
    numbers.push_back(random.chance(0.05) ? std::numeric_limits<float>::quiet_NaN()
                                          : static_cast<float>(random.uniform(0.5, 2)));
  return numbers;
}

TEST(InstructionSetTest, PointsAreReadTheSame)
{
  const std::vector<float> numbers = scattered(31 * 7);
  OrganizedPoints expected;
  expected.load(31, 7, numbers.data(), 4);
  forEachInstructionSet([&](const char* name) {
    OrganizedPoints points;
    points.load(31, 7, numbers.data(), 4);
    EXPECT_EQ(points.x, expected.x) << name;
    EXPECT_EQ(points.y, expected.y) << name;
    EXPECT_EQ(points.z, expected.z) << name;
    EXPECT_EQ(points.valid, expected.valid) << name;
  });
}

TEST(InstructionSetTest, TheNoiseOfCellsIsThatOfTheLawTimesTheFactor)
{
  using namespace adaptive;
  constexpr double UNTOUCHED = 4711;
  scenes::Random random(8);
  NoiseLaw law;
  law.a = 0.001;
  law.b = 0.0003;
  law.c = 0.002;
  law.floor = 0.0008;
  for (std::size_t count = 1; count < 14; ++count) {
    std::vector<TileSums> cells(count + 1);
    for (TileSums& cell : cells) {
      const int points = random.chance(0.2) ? 0 : random.integer(1, 16);
      for (int k = 0; k < points; ++k)
        cell.add(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 5));
      cell.noise = UNTOUCHED;
    }
    std::vector<double> factors((count + CELLS_A_FACTOR - 1) / CELLS_A_FACTOR);
    for (double& factor : factors)
      factor = random.uniform(1, 3);
    forEachInstructionSet([&](const char* name) {
      std::vector<TileSums> assigned = cells;
      assignNoise(assigned.data(), count, factors.data(), law);
      for (std::size_t k = 0; k < count; ++k) {
        const TileSums& cell = cells[k];
        double expected = 0;
        if (cell.n >= 1) {
          const double range =
              std::sqrt(cell.x * cell.x + cell.y * cell.y + cell.z * cell.z) / cell.n;
          const double sigma = law.small(range) * factors[k / CELLS_A_FACTOR];
          expected = cell.n * sigma * sigma;
        }
        EXPECT_EQ(assigned[k].noise, expected)
            << "cell " << k << " of " << count << " on " << name;
      }
      EXPECT_EQ(assigned[count].noise, UNTOUCHED)
          << "wrote beyond " << count << " cells on " << name;
    });
  }
}

TEST(InstructionSetTest, TheWholeSegmentationGivesTheSameBits)
{
  const OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 321, 243, 4, scenes::SensorNoise::kinect()));
  for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER}) {
    const Parameters parameters = Parameters::fromProfile(profile);
    const PlaneSegmentation expected = segmentPlanes(points, parameters);
    EXPECT_FALSE(expected.regions.empty());
    forEachInstructionSet([&](const char* name) {
      const PlaneSegmentation result = segmentPlanes(points, parameters);
      EXPECT_EQ(result.labels, expected.labels) << "other labels on " << name;
      ASSERT_EQ(result.regions.size(), expected.regions.size()) << name;
      for (std::size_t k = 0; k < result.regions.size(); ++k) {
        const Plane& plane = result.regions[k].plane;
        EXPECT_EQ(plane.normal, expected.regions[k].plane.normal) << name;
        EXPECT_EQ(plane.d, expected.regions[k].plane.d) << name;
        EXPECT_EQ(result.regions[k].rms, expected.regions[k].rms) << name;
      }
    });
  }
}

} // namespace
} // namespace pcl_mrf_planes
