// SPDX-License-Identifier: BSD-3-Clause
#include "reference/energy.h"
#include "reference/grid_problem.h"
#include "reference/inputs.h"
#include "reference/propagation.h"

#include <pcl_mrf_planes/plane_field.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pcl_mrf_planes {
namespace {

using reference::GridProblem;
using reference::PaperEnergy;

std::vector<Plane> randomPlanes(scenes::Random& random, int count)
{
  std::vector<Plane> planes;
  for (int i = 0; i < count; ++i)
    planes.push_back(reference::randomPlane(random));
  return planes;
}

reference::Labels randomLabels(scenes::Random& random, std::size_t sites, int labels)
{
  reference::Labels result;
  for (std::size_t i = 0; i < sites; ++i)
    result.push_back(static_cast<std::uint16_t>(random.integer(0, labels - 1)));
  return result;
}

struct Size {
  int width, height;
};

using FieldCase = std::tuple<Size, int, Smoothness>;

class PlaneFieldTest : public testing::TestWithParam<FieldCase> {
protected:
  PlaneFieldTest()
  {
    parameters_.smoothness = std::get<2>(GetParam());
    parameters_.gamma = 0.3;
  }

  const Size size_ = std::get<0>(GetParam());
  const int labels_ = std::get<1>(GetParam());
  scenes::Random random_{31};
  const OrganizedPoints points_ =
      reference::randomPoints(random_, size_.width, size_.height);
  const std::vector<Plane> planes_ = randomPlanes(random_, labels_);
  Parameters parameters_;
};

INSTANTIATE_TEST_SUITE_P(
    Cases, PlaneFieldTest,
    testing::Combine(testing::Values(Size{1, 1}, Size{1, 9}, Size{9, 2}, Size{33, 17}),
                     testing::Values(1, 2, 9),
                     testing::Values(Smoothness::POTTS, Smoothness::DISSIMILARITY,
                                     Smoothness::HYBRID, Smoothness::PREDICTED_DEPTH)));

TEST_P(PlaneFieldTest, CostsAreTheReferenceWithinHalfAUnit)
{
  const PlaneField field(points_, planes_, parameters_);
  const GridField grid = field.toGridField();
  const PaperEnergy exact(points_, reference::toVectors(planes_), parameters_);
  const double units = field.unitsPerEnergy();
  // Half a unit of rounding, and a few single precision roundings of metres.
  const double bound = 0.5 + 4e-6 * units * parameters_.lambda;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x) {
      const auto i = static_cast<std::size_t>(y * size_.width + x);
      for (int l = 0; l < labels_; ++l) {
        EXPECT_NEAR(grid.data(x, y, l), units * exact.data(x, y, l), bound)
            << "data term (7) of label " << l << " at " << x << ", " << y;
        if (points_.valid[i] == 0) {
          EXPECT_EQ(grid.data(x, y, l), 0)
              << "a point that was not measured has no cost";
        }
        else {
          EXPECT_NEAR(field.dataTerm(i, l), exact.data(x, y, l), 1e-12);
        }
      }
    }
}

TEST_P(PlaneFieldTest, EdgesJoinMeasuredNeighboursOnly)
{
  const PlaneField field(points_, planes_, parameters_);
  const GridField grid = field.toGridField();
  const PaperEnergy exact(points_, reference::toVectors(planes_), parameters_);
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x) {
      EXPECT_EQ(grid.rightEdge(x, y) != GridField::NO_EDGE,
                exact.connected(x, y, x + 1, y))
          << "edge to the right of " << x << ", " << y;
      EXPECT_EQ(grid.downEdge(x, y) != GridField::NO_EDGE,
                exact.connected(x, y, x, y + 1))
          << "edge below " << x << ", " << y;
    }
}

TEST_P(PlaneFieldTest, PricesAreTheReferenceLessTheDepthStepWithinAUnit)
{
  const PlaneField field(points_, planes_, parameters_);
  const GridField grid = field.toGridField();
  const GridProblem whole(grid);
  const PaperEnergy exact(points_, reference::toVectors(planes_), parameters_);
  const double units = field.unitsPerEnergy();
  const bool hybrid = parameters_.smoothness == Smoothness::HYBRID;
  const bool predicted = parameters_.smoothness == Smoothness::PREDICTED_DEPTH;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x + 1 < size_.width; ++x) {
      if (!exact.connected(x, y, x + 1, y))
        continue;
      const double dz = exact.depth(x, y) - exact.depth(x + 1, y);
      for (int a = 0; a < labels_; ++a)
        for (int b = 0; b < labels_; ++b) {
          const double paid_anyway = hybrid ? std::abs(dz) : 0.0;
          const double price = exact.price(x, y, x + 1, y, a, b) - paid_anyway;
          // Two rounded terms; the variant multiplies two rounded factors.
          const double bound = 1.0 + 4e-6 * units +
                               (predicted ? 1.5 + units * std::abs(dz) / 32768.0 : 0.0);
          EXPECT_NEAR(static_cast<double>(whole.price(x, y, x + 1, y, a, b)),
                      units * price, bound)
              << "labels " << a << ", " << b << " with a step of " << dz << " m";
          EXPECT_NEAR(field.smoothnessTerm(a, b, dz), exact.smoothness(a, b, dz),
                      1e-12);
          EXPECT_EQ(field.smoothnessTerm(a, b, dz), field.smoothnessTerm(b, a, -dz))
              << "the price must not depend on the direction of the edge";
        }
    }
  for (int a = 0; a < labels_; ++a) {
    EXPECT_EQ(grid.pairwise(a, a), 0) << "keeping the label is free";
    for (int b = 0; b < labels_; ++b)
      EXPECT_EQ(grid.pairwise(a, b), grid.pairwise(b, a)) << "not symmetric";
  }
}

TEST_P(PlaneFieldTest, NoSumOverflowsSixteenBits)
{
  const PlaneField field(points_, planes_, parameters_);
  const GridField grid = field.toGridField();
  const GridProblem whole(grid);
  std::int64_t data = 0;
  std::int64_t price = 0;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x)
      for (int a = 0; a < labels_; ++a) {
        data = std::max(data, whole.data(x, y, a));
        for (int b = 0; b < labels_; ++b) {
          if (whole.connected(x, y, x + 1, y))
            price = std::max(price, whole.price(x, y, x + 1, y, a, b));
          if (whole.connected(x, y, x, y + 1))
            price = std::max(price, whole.price(x, y, x, y + 1, a, b));
        }
      }
  EXPECT_LE(data + 4 * price, 65535) << "a belief can overflow";
}

TEST_P(PlaneFieldTest, EnergyIsTheSumOfItsTermsAndTheUnitsOrderAlike)
{
  const PlaneField field(points_, planes_, parameters_);
  const GridField grid = field.toGridField();
  const PaperEnergy exact(points_, reference::toVectors(planes_), parameters_);
  const auto labels = randomLabels(random_, points_.size(), labels_);
  const double expected = reference::energyOf(exact, labels);
  const FieldEnergy energy = field.energy(labels);
  EXPECT_NEAR(energy.total(), expected, 1e-9 * (1.0 + expected))
      << "equation (6) summed over the sites, each edge once";
  EXPECT_GE(energy.data, 0.0);
  EXPECT_EQ(grid.energy(labels),
            static_cast<std::uint64_t>(reference::energyOf(GridProblem(grid), labels)))
      << "the energy in units is the sum of the grid's own costs";
  if (parameters_.smoothness == Smoothness::PREDICTED_DEPTH)
    return; // its prices multiply two rounded factors: no bound is promised
  const auto others = randomLabels(random_, points_.size(), labels_);
  const double difference = field.energy(labels).total() - field.energy(others).total();
  const double in_units = static_cast<double>(grid.energy(labels)) -
                          static_cast<double>(grid.energy(others));
  const auto sites = static_cast<double>(points_.countValid());
  double edges = 0;
  for (int y = 0; y < size_.height; ++y)
    for (int x = 0; x < size_.width; ++x)
      edges += (exact.connected(x, y, x + 1, y) ? 1 : 0) +
               (exact.connected(x, y, x, y + 1) ? 1 : 0);
  // Half a unit a site and a unit an edge for either of the two labellings.
  EXPECT_NEAR(in_units, field.unitsPerEnergy() * difference,
              (sites + 2.0 * edges) * 1.01 + 1.0)
      << "rounding to units distorts the energy more than promised";
}

TEST(PlaneFieldSpecialTest, RangeImagesTakeTheRangeAsDepth)
{
  scenes::Random random(5);
  OrganizedPoints points = reference::randomPoints(random, 9, 7, 1.0);
  points.depth_measure = DepthMeasure::RANGE;
  const Parameters parameters;
  const auto planes = randomPlanes(random, 3);
  const PlaneField field(points, planes, parameters);
  const GridField grid = field.toGridField();
  for (int y = 0; y < 7; ++y)
    for (int x = 0; x + 1 < 9; ++x) {
      const auto i = static_cast<std::size_t>(y * 9 + x);
      const double step =
          std::abs(static_cast<double>(points.depth(i)) - points.depth(i + 1));
      EXPECT_NEAR(grid.rightEdge(x, y),
                  std::min(65534.0, field.unitsPerEnergy() * step), 0.51)
          << "the step of a lidar is that of its range";
    }
}

TEST(PlaneFieldSpecialTest, HugeDepthStepsAreNotMissingEdges)
{
  OrganizedPoints points;
  points.resize(2, 2);
  points.set(0, 0, 0, 1);
  points.set(1, 0, 0, 900000);
  points.set(2, 0, 0, 2);
  points.set(3, 0, 0, 500000);
  scenes::Random random(6);
  const PlaneField field(points, randomPlanes(random, 2), Parameters());
  const GridField grid = field.toGridField();
  EXPECT_EQ(grid.rightEdge(0, 0), 65534) << "the largest weight, not NO_EDGE";
  EXPECT_EQ(grid.downEdge(1, 0), 65534) << "the largest weight, not NO_EDGE";
  EXPECT_EQ(grid.price(0, 1, grid.rightEdge(0, 0)), 0U)
      << "a label change across a cliff is free";
}

TEST(PlaneFieldSpecialTest, NoWeightsAtAllIsStillAField)
{
  scenes::Random random(7);
  const OrganizedPoints points = reference::randomPoints(random, 5, 5);
  Parameters parameters;
  parameters.lambda = 0.0;
  parameters.smoothness = Smoothness::POTTS;
  parameters.gamma = 0.0;
  const PlaneField field(points, randomPlanes(random, 3), parameters);
  const GridField grid = field.toGridField();
  EXPECT_TRUE(std::isfinite(field.unitsPerEnergy()));
  EXPECT_EQ(grid.energy(reference::Labels(25, 1)), 0U) << "no costs, no energy";
}

} // namespace
} // namespace pcl_mrf_planes
