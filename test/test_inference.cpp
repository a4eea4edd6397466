// SPDX-License-Identifier: BSD-3-Clause
//
// How near the labels of Method::ADAPTIVE come to the least energy: exactly where dynamic
// programming can tell, and by a lower bound where it cannot.
#include "adaptive/candidate_field.h"
#include "reference/candidate_fields.h"
#include "reference/lower_bound.h"
#include "reference/potts_grid.h"

#include <gtest/gtest.h>

namespace pcl_mrf_planes::adaptive {
namespace {

using namespace reference;

constexpr int WIDTH = 3; // of the strips: 27 labellings a row
constexpr int HEIGHT = 20;
constexpr LabelCount FEW = {2, 3};
constexpr int ITERATIONS = 100;
constexpr int ENOUGH_PASSES = 40;
constexpr double ROUNDING = 1e-9; // share of the energy

double boundOf(const PottsGrid& grid, int iterations = ITERATIONS)
{
  LowerBound bound(grid);
  for (int k = 0; k < iterations; ++k)
    bound.iterate();
  return bound.bound();
}

double energyAfter(const CandidateField& field, const OrganizedPoints& points,
                   int passes)
{
  return static_cast<double>(
      energyOf(field, points, propagateBeliefs(field, points, passes)));
}

TEST(InferenceTest, BoundOfChainsIsTheirLeastEnergy)
{
  scenes::Random random(1);
  for (int k = 0; k < 20; ++k)
    for (const bool column : {true, false}) {
      const CandidateField field = column ? randomField(random, 1, HEIGHT, FEW)
                                          : randomField(random, WIDTH, 1, FEW);
      const PottsGrid grid = toPottsGrid(field);
      const double least = NarrowGridMinimum(grid).energy();
      EXPECT_NEAR(boundOf(grid), least, ROUNDING * least);
    }
}

TEST(InferenceTest, BoundIsNeverAboveTheLeastEnergyAndNeverFalls)
{
  scenes::Random random(2);
  for (int k = 0; k < 50; ++k) {
    const CandidateField field = randomField(random, WIDTH, HEIGHT, FEW);
    const PottsGrid grid = toPottsGrid(field);
    const double least = NarrowGridMinimum(grid).energy();
    LowerBound bound(grid);
    double before = bound.bound();
    EXPECT_LE(before, least * (1 + ROUNDING));
    for (int t = 0; t < ITERATIONS; ++t) {
      bound.iterate();
      EXPECT_LE(bound.bound(), least * (1 + ROUNDING)) << "iteration " << t;
      // The first time some messages are not there yet.
      if (t > 0) {
        EXPECT_GE(bound.bound(), before * (1 - ROUNDING)) << "iteration " << t;
      }
      before = bound.bound();
    }
    EXPECT_GE(before, 0.99 * least) << "field " << k;
  }
}

// On average, with random costs and prices.
TEST(InferenceTest, EnergyOfStripsIsWithinHalfAPercentOfTheLeast)
{
  scenes::Random random(3);
  double energies = 0.0;
  double least_energies = 0.0;
  for (int k = 0; k < 100; ++k) {
    const CandidateField field = randomField(random, WIDTH, HEIGHT, FEW);
    const double energy = energyAfter(field, allValid(WIDTH, HEIGHT), ENOUGH_PASSES);
    const double least = NarrowGridMinimum(toPottsGrid(field)).energy();
    EXPECT_GE(energy, least) << "field " << k;
    energies += energy;
    least_energies += least;
  }
  EXPECT_LE(energies, 1.005 * least_energies);
}

// Of the energy of all points: which blocks are settled does not matter.
TEST(InferenceTest, EnergyOfScenesIsWithinSixPerMilleOfTheBound)
{
  for (const char* scene : {"corner", "box_on_table", "room"})
    for (const auto& sensor :
         {scenes::SensorNoise::none(), scenes::SensorNoise::kinect()}) {
      const AdaptiveParameters parameters;
      const CloudField s = sceneField(scene, sensor, parameters);
      double settled = 0.0;
      s.forEachSettled([&](std::size_t i, std::size_t /*block*/, std::uint16_t label) {
        settled += s.dataCost(i, label, parameters) * unitsPerSigma(parameters);
      });
      const double bound = boundOf(toPottsGrid(s.field), 20);
      const double energy = energyAfter(s.field, s.points, parameters.passes);
      EXPECT_GE(energy, bound * (1 - ROUNDING)) << scene;
      EXPECT_LE(energy - bound, 0.006 * (bound + settled)) << scene;
    }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
