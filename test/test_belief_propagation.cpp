// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grid_problem.h"
#include "reference/inputs.h"
#include "reference/propagation.h"

#include <pcl_mrf_planes/belief_gap.h>
#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace pcl_mrf_planes {
namespace {

using reference::GridProblem;
using reference::randomField;

struct Size {
  int width, height;
};

using GridCase = std::tuple<Size, int, EdgeModel>;

class PropagationTest : public testing::TestWithParam<GridCase> {
protected:
  GridField makeField(std::uint64_t seed, double edges = 0.9) const
  {
    scenes::Random random(seed);
    const Size size = std::get<0>(GetParam());
    return randomField(random, size.width, size.height, std::get<1>(GetParam()),
                       std::get<2>(GetParam()), edges);
  }
};

INSTANTIATE_TEST_SUITE_P(
    Grids, PropagationTest,
    testing::Combine(
        testing::Values(Size{1, 1}, Size{1, 40}, Size{70, 1}, Size{2, 2}, Size{17, 9},
                        Size{33, 65}, Size{64, 64}, Size{65, 33}, Size{131, 6}),
        testing::Values(1, 2, 3, 10, 40),
        testing::Values(EdgeModel::SOFT_THRESHOLD, EdgeModel::SCALED_MAXIMUM)));

TEST_P(PropagationTest, IsThePlainReferenceBitForBit)
{
  const GridField field = makeField(1);
  const GridProblem problem(field);
  reference::Propagation<GridProblem> plain(problem);
  BeliefPropagation fast(field);
  int done = 0;
  const bool small = field.width() * field.height() * field.labels() < 20000;
  for (const int iterations : {0, 1, 2, 5, small ? 20 : 8}) {
    plain.iterate(iterations - done);
    EXPECT_EQ(fast.iterate(iterations - done), iterations - done);
    done = iterations;
    const auto expected = plain.mapLabels();
    ASSERT_EQ(fast.mapLabels(), expected) << "labels after " << iterations;
    ASSERT_EQ(propagateRows(field, iterations), expected)
        << "row by row gives other labels after " << iterations;
    ASSERT_EQ(propagateRowGaps(field, iterations), beliefGaps(field, fast))
        << "row by row gives other gaps after " << iterations;
    std::size_t different = 0;
    for (int direction = 0; direction < 4; ++direction)
      for (int y = 0; y < field.height(); ++y)
        for (int x = 0; x < field.width(); ++x)
          for (int l = 0; l < field.labels(); ++l)
            different +=
                fast.message(direction, x, y, l) != plain.message(direction, x, y, l)
                    ? 1U
                    : 0U;
    EXPECT_EQ(different, 0U) << "messages differ after " << iterations;
  }
}

TEST_P(PropagationTest, ThreadsGiveTheSameLabels)
{
  const GridField field = makeField(2);
  for (const int iterations : {1, 3, 7}) {
    BeliefPropagation one(field);
    one.iterate(iterations);
    const auto expected = one.mapLabels();
    for (const unsigned int threads : {0U, 2U, 3U, 8U}) {
      BeliefPropagation many(field, threads);
      many.iterate(iterations);
      EXPECT_EQ(many.mapLabels(), expected) << threads << " threads";
      EXPECT_EQ(propagateRows(field, iterations, threads), expected)
          << threads << " threads, row by row, " << iterations << " iterations";
      EXPECT_EQ(propagateRowGaps(field, iterations, threads), beliefGaps(field, one))
          << threads << " threads";
    }
  }
}

// Bounds that are equal, labels that are equal, edges that are free or missing.
TEST_P(PropagationTest, TiesAreTheSameRowByRow)
{
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    GridField field = makeField(seed, 0.7);
    scenes::Random random(100 + seed);
    const auto few = [&] {
      return static_cast<std::uint16_t>(random.chance(0.5) ? 1 : 2);
    };
    for (int a = 0; a < field.labels(); ++a)
      for (int b = 0; b < a; ++b)
        field.setPairwise(a, b, few());
    for (int y = 0; y < field.height(); ++y)
      for (int x = 0; x < field.width(); ++x) {
        for (int l = 0; l < field.labels(); ++l)
          field.setData(x, y, l, few());
        if (field.rightEdge(x, y) != GridField::NO_EDGE)
          field.setRightEdge(x, y, random.chance(0.7) ? 0 : 1);
        if (field.downEdge(x, y) != GridField::NO_EDGE)
          field.setDownEdge(x, y, random.chance(0.7) ? 0 : 3);
      }
    for (const int iterations : {1, 5}) {
      BeliefPropagation plain(field);
      plain.iterate(iterations);
      for (const unsigned int threads : {1U, 8U})
        ASSERT_EQ(propagateRows(field, iterations, threads), plain.mapLabels())
            << "seed " << seed << ", " << iterations << " iterations, " << threads
            << " threads";
    }
  }
}

TEST_P(PropagationTest, WithoutEdgesTheCheapestLabelWins)
{
  const GridField field = makeField(3, 0.0);
  BeliefPropagation propagation(field);
  const auto before = propagation.mapLabels();
  EXPECT_EQ(propagation.iterate(4), 4);
  EXPECT_EQ(propagation.mapLabels(), before) << "NO_EDGE must carry nothing";
  EXPECT_EQ(propagateRows(field, 4), before) << "NO_EDGE must carry nothing";
  for (int y = 0; y < field.height(); ++y)
    for (int x = 0; x < field.width(); ++x) {
      const int label = before[static_cast<std::size_t>(y * field.width() + x)];
      for (int l = 0; l < field.labels(); ++l) {
        if (l < label) {
          EXPECT_GT(field.data(x, y, l), field.data(x, y, label))
              << "smallest label wins";
        }
        else {
          EXPECT_GE(field.data(x, y, l), field.data(x, y, label));
        }
        for (int direction = 0; direction < 4; ++direction)
          ASSERT_EQ(propagation.message(direction, x, y, l), 0)
              << "NO_EDGE must carry nothing";
      }
    }
}

class ChainTest : public testing::TestWithParam<std::tuple<int, int, EdgeModel>> {};

INSTANTIATE_TEST_SUITE_P(Chains, ChainTest,
                         testing::Combine(testing::Values(1, 2, 7, 40, 65),
                                          testing::Values(2, 5, 12),
                                          testing::Values(EdgeModel::SOFT_THRESHOLD,
                                                          EdgeModel::SCALED_MAXIMUM)));

TEST_P(ChainTest, IsExactOnceSettled)
{
  const auto [length, labels, model] = GetParam();
  scenes::Random random(17);
  for (int round = 0; round < 6; ++round) {
    const bool flat = round % 2 == 0;
    const GridField field =
        randomField(random, flat ? length : 1, flat ? 1 : length, labels, model);
    BeliefPropagation propagation(field);
    const int limit = 2 * length + 4;
    const int done = propagation.iterate(limit, 0);
    EXPECT_TRUE(propagation.settled(0)) << "a chain must settle in two sweeps";
    EXPECT_LE(done, limit);
    const auto found = propagation.mapLabels();
    EXPECT_EQ(static_cast<std::int64_t>(field.energy(found)),
              reference::leastChainEnergy(GridProblem(field)))
        << "on a chain the result is the minimum (dynamic programming)";
  }
}

/// A random tree: every site but the first is joined to one neighbour before it.
GridField randomTree(scenes::Random& random, int width, int height, int labels,
                     EdgeModel model)
{
  GridField field = randomField(random, width, height, labels, model, 1.0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool to_left = x > 0 && (y == 0 || random.chance(0.5));
      if (x > 0 && !to_left)
        field.setRightEdge(x - 1, y, GridField::NO_EDGE);
      if (y > 0 && to_left)
        field.setDownEdge(x, y - 1, GridField::NO_EDGE);
    }
  return field;
}

TEST(PropagationOptimumTest, TreesAreSolvedExactly)
{
  scenes::Random random(23);
  for (int round = 0; round < 40; ++round) {
    const EdgeModel model =
        round % 2 == 0 ? EdgeModel::SOFT_THRESHOLD : EdgeModel::SCALED_MAXIMUM;
    const GridField field = randomTree(random, 3, 3, 3, model);
    BeliefPropagation propagation(field);
    propagation.iterate(60, 0);
    EXPECT_TRUE(propagation.settled(0)) << "a tree must settle, round " << round;
    EXPECT_EQ(static_cast<std::int64_t>(field.energy(propagation.mapLabels())),
              reference::leastEnergy(GridProblem(field)))
        << "on a tree the result is the minimum (all labellings tried), round "
        << round;
  }
}

TEST(PropagationOptimumTest, ChainReferenceAgreesWithTryingAll)
{
  scenes::Random random(29);
  for (int round = 0; round < 20; ++round) {
    const GridField field =
        randomField(random, round % 2 == 0 ? 7 : 1, round % 2 == 0 ? 1 : 7, 3,
                    EdgeModel::SOFT_THRESHOLD);
    EXPECT_EQ(reference::leastChainEnergy(GridProblem(field)),
              reference::leastEnergy(GridProblem(field)))
        << "the two references contradict each other";
  }
}

TEST(PropagationOptimumTest, SmallGridsAreBoundedByTheMinimum)
{
  scenes::Random random(37);
  int exact = 0;
  for (int round = 0; round < 60; ++round) {
    const GridField field = randomField(random, 3, 3, 3, EdgeModel::SOFT_THRESHOLD);
    const auto least = reference::leastEnergy(GridProblem(field));
    const auto found =
        static_cast<std::int64_t>(field.energy(propagateRows(field, 30)));
    EXPECT_GE(found, least) << "below the minimum: the energy is wrong";
    exact += found == least ? 1 : 0;
  }
  EXPECT_GE(exact, 45) << "loopy propagation finds the minimum of most 3 x 3 grids";
}

TEST(PropagationOptimumTest, RandomFieldsNeverEndAboveTheirInitialLabels)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    scenes::Random random(seed);
    const EdgeModel model =
        seed % 2 == 0 ? EdgeModel::SOFT_THRESHOLD : EdgeModel::SCALED_MAXIMUM;
    const GridField field =
        randomField(random, 20, 15, 2 + static_cast<int>(seed % 6), model);
    BeliefPropagation propagation(field);
    const auto initial = field.energy(propagation.mapLabels());
    for (int t = 1; t <= 20; ++t) {
      propagation.iterate(1);
      EXPECT_LE(field.energy(propagation.mapLabels()), initial)
          << "field " << seed << " after " << t << " iterations";
    }
  }
}

TEST(PropagationStopTest, StopsWhenSettledAndChangesNothingAfterwards)
{
  scenes::Random random(41);
  const GridField field = randomTree(random, 30, 20, 6, EdgeModel::SOFT_THRESHOLD);
  BeliefPropagation propagation(field);
  EXPECT_FALSE(propagation.settled(0)) << "nothing was sent yet";
  EXPECT_FALSE(propagation.settled(-1)) << "a negative tolerance is never reached";
  const int done = propagation.iterate(5000, 0);
  EXPECT_LT(done, 1000) << "did not stop";
  EXPECT_TRUE(propagation.settled(0));
  EXPECT_FALSE(propagation.settled(-1)) << "a negative tolerance is never reached";
  EXPECT_EQ(propagation.iterate(10, 0), 0) << "settled means nothing is left to do";
  const auto labels = propagation.mapLabels();
  EXPECT_EQ(propagation.sendMessages(0), 0) << "a settled message changed";
  EXPECT_EQ(propagation.sendMessages(1), 0) << "a settled message changed";
  EXPECT_EQ(propagation.iterate(3), 3) << "without a tolerance all iterations are done";
  EXPECT_EQ(propagation.mapLabels(), labels) << "labels changed after settling";
}

TEST(PropagationStopTest, ALooserToleranceStopsNoLater)
{
  scenes::Random random(43);
  const GridField field = randomField(random, 40, 30, 5, EdgeModel::SOFT_THRESHOLD);
  int last = 1000;
  for (const int tolerance : {0, 10, 1000, 65535}) {
    BeliefPropagation propagation(field);
    const int done = propagation.iterate(200, tolerance);
    EXPECT_LE(done, last) << "tolerance " << tolerance;
    last = done;
  }
  EXPECT_EQ(last, 2) << "any change is within 65535 once both colours have sent";
}

TEST(PropagationStopTest, LargestChangeIsReported)
{
  GridField field(2, 1, 2);
  field.setPairwise(0, 1, 1000);
  field.setRightEdge(0, 0, 100);
  field.setData(0, 0, 0, 5000);
  BeliefPropagation propagation(field);
  EXPECT_EQ(propagation.sendMessages(0), 900) << "min(h, pairwise - weight)";
  EXPECT_EQ(propagation.message(BeliefPropagation::FROM_LEFT, 1, 0, 0), 900);
  EXPECT_EQ(propagation.message(BeliefPropagation::FROM_LEFT, 1, 0, 1), 0);
  EXPECT_EQ(propagation.sendMessages(0), 0) << "the same message again is no change";
}

} // namespace
} // namespace pcl_mrf_planes
