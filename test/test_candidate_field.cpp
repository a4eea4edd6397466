// SPDX-License-Identifier: BSD-3-Clause
//
// The random field of Method::ADAPTIVE, whose labels compete block by block.
#include "adaptive/candidate_field.h"
#include "reference/candidate_fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::adaptive {
namespace {

using namespace reference;

/// Least energy of an image of one row or one column, by dynamic programming.
long leastEnergyOfChain(const CandidateField& field)
{
  const bool is_row = field.height == 1;
  const int length = is_row ? field.width : field.height;
  std::vector<long> best(ALL_LABELS, 0);
  for (int k = 0; k < length; ++k) {
    const int x = is_row ? k : 0;
    const int y = is_row ? 0 : k;
    long change = 0;
    if (k > 0)
      change = is_row ? rightEdge(field, x - 1, y) : downEdge(field, x, y - 1);
    const long least = *std::min_element(best.begin(), best.end());
    for (int label = 0; label < ALL_LABELS; ++label) {
      long& cost = best[static_cast<std::size_t>(label)];
      cost = std::min(FORBIDDEN,
                      std::min(cost, least + change) + dataCost(field, x, y, label));
    }
  }
  return *std::min_element(best.begin(), best.end());
}

TEST(CandidateFieldTest, NoPassesGiveTheLeastDataCosts)
{
  scenes::Random random(1);
  for (const int width : {1, 7, 8, 9, 40})
    for (const int height : {1, 8, 13}) {
      const CandidateField field = randomField(random, width, height);
      const OrganizedPoints points = allValid(width, height);
      const auto labels = propagateBeliefs(field, points, 0);
      ASSERT_EQ(labels.size(), points.size());
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const int label = labels[static_cast<std::size_t>(y * width + x)];
          long least = FORBIDDEN;
          for (int other = 0; other < ALL_LABELS; ++other)
            least = std::min(least, dataCost(field, x, y, other));
          EXPECT_EQ(dataCost(field, x, y, label), least)
              << x << ", " << y << " of " << width << "x" << height;
        }
    }
}

// Belief propagation is exact on a tree: down a column in one pass, along a row in as
// many passes as it has points.
TEST(CandidateFieldTest, ColumnsAreSolvedExactlyInOnePass)
{
  scenes::Random random(2);
  for (const int height : {1, 2, 7, 8, 9, 16, 40, 163})
    for (int k = 0; k < 20; ++k) {
      const CandidateField field = randomField(random, 1, height);
      const OrganizedPoints points = allValid(1, height);
      EXPECT_EQ(energyOf(field, points, propagateBeliefs(field, points, 1)),
                leastEnergyOfChain(field))
          << height << " points, field " << k;
    }
}

TEST(CandidateFieldTest, RowsAreSolvedExactlyOnceMessagesHaveCrossed)
{
  scenes::Random random(3);
  for (const int width : {1, 2, 7, 8, 9, 16, 40, 163})
    for (int k = 0; k < 20; ++k) {
      const CandidateField field = randomField(random, width, 1);
      const OrganizedPoints points = allValid(width, 1);
      EXPECT_EQ(energyOf(field, points, propagateBeliefs(field, points, width)),
                leastEnergyOfChain(field))
          << width << " points, field " << k;
    }
}

// Propagation is no descent, so that it ends below where it began is no theorem; it
// does on random fields as well as on scenes.
TEST(CandidateFieldTest, PassesLowerTheEnergyOfRandomFields)
{
  scenes::Random random(4);
  for (int k = 0; k < 20; ++k) {
    const int width = random.integer(2, 70);
    const int height = random.integer(2, 50);
    const CandidateField field = randomField(random, width, height);
    const OrganizedPoints points = allValid(width, height);
    const long before = energyOf(field, points, propagateBeliefs(field, points, 0));
    for (const int passes : {1, 3, 20})
      EXPECT_LE(energyOf(field, points, propagateBeliefs(field, points, passes)),
                before)
          << width << "x" << height << ", " << passes << " passes";
  }
}

const std::vector<const char*> SCENES = {"corner", "stairs", "box_on_table", "room",
                                         "step"};
const std::vector<scenes::SensorNoise> SENSORS = {scenes::SensorNoise::none(),
                                                  scenes::SensorNoise::kinect()};

// One pass does not always: it reads labels off while messages along the rows are still
// on their way.
TEST(CandidateFieldTest, PassesLowerTheEnergyOfScenes)
{
  for (const char* scene : SCENES)
    for (const auto& sensor : SENSORS) {
      const CloudField s = sceneField(scene, sensor, {});
      const auto energy = [&](int passes) {
        return static_cast<double>(
            energyOf(s.field, s.points, propagateBeliefs(s.field, s.points, passes)));
      };
      const double before = energy(0);
      for (const int passes : {1, 2, 10})
        EXPECT_LE(energy(passes), before * (passes == 1 ? 1.002 : 1.0))
            << scene << ", " << passes << " passes";
    }
}

TEST(CandidateFieldTest, WhatHasAChoiceHasNoPlaneAmongItsLabels)
{
  for (const char* scene : SCENES) {
    const CloudField s = sceneField(scene, scenes::SensorNoise::kinect(), {});
    ASSERT_EQ(s.field.number.size(), s.field.blocks.count.size());
    EXPECT_FALSE(s.field.active.empty()) << scene;
    for (std::size_t b = 0; b < s.field.blocks.count.size(); ++b)
      if (s.field.number[b] != CandidateField::SETTLED) {
        EXPECT_EQ(s.field.active[s.field.number[b]], b);
        EXPECT_GE(s.field.blocks.count[b], 2) << "a block of one label is settled";
        EXPECT_EQ(s.field.blocks.labelsOf(b)[0], 0)
            << "\"no plane\" competes everywhere";
      }
      else
        EXPECT_EQ(s.field.blocks.count[b], 1) << "a settled block has one label";
  }
}

// A block is settled without a look at its neighbours: by plain arithmetic, its points lie
// so near its plane that no hole pays for its border.
// No hole in the plane of a settled block pays, by one of two bounds: of k points it saves at
// most sqrt(k) sqrt(sum of squares) - k times the cost of "no plane" and costs 4 sqrt(k)
// changes; or it saves what the points far off save together, less than the two changes that
// a point costs more even on a side of the block that "no plane" is beyond.
TEST(CandidateFieldTest, PointsOfSettledBlocksLieOnTheirPlane)
{
  const AdaptiveParameters parameters;
  const double most = parameters.none_cost + 4 * parameters.label_change; // sigmas
  std::size_t settled = 0;
  std::size_t all = 0;
  for (const char* scene : SCENES)
    for (const auto& sensor : SENSORS) {
      const CloudField s = sceneField(scene, sensor, parameters);
      std::vector<double> squares(s.field.number.size(), 0.0); // by block
      std::vector<double> savings(s.field.number.size(), 0.0);
      s.forEachSettled([&](std::size_t i, std::size_t b, std::uint16_t label) {
        ++settled;
        if (label == 0)
          return;
        const double cost = s.dataCost(i, label, parameters);
        squares[b] += cost * cost;
        savings[b] += std::max(0.0, cost - parameters.none_cost);
      });
      all += s.points.size();
      for (std::size_t b = 0; b < squares.size(); ++b)
        EXPECT_TRUE(std::sqrt(squares[b]) <= 1.01 * most ||
                    savings[b] <= 1.01 * 2 * parameters.label_change)
            << scene << ": squares " << squares[b] << ", savings " << savings[b];
    }
  EXPECT_GT(settled, all / 2) << "most blocks have no choice";
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
