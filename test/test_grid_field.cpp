// SPDX-License-Identifier: BSD-3-Clause
#include "reference/grid_problem.h"
#include "reference/inputs.h"
#include "reference/propagation.h"

#include <pcl_mrf_planes/grid_field.h>

#include <gtest/gtest.h>

#include <set>

namespace pcl_mrf_planes {
namespace {

TEST(PairPricesTest, AreSymmetricAndFollowTheEdgeModel)
{
  PairPrices soft(3, EdgeModel::SOFT_THRESHOLD);
  soft.setPairwise(0, 2, 1000);
  EXPECT_EQ(soft.pairwise(2, 0), 1000) << "a pair has no order";
  EXPECT_EQ(soft.price(0, 2, 0), 1000U);
  EXPECT_EQ(soft.price(2, 0, 400), 600U) << "max(0, pairwise - weight)";
  EXPECT_EQ(soft.price(0, 2, 1001), 0U) << "max(0, pairwise - weight)";
  EXPECT_EQ(soft.price(0, 2, PairPrices::NO_EDGE), 0U) << "no edge, no price";

  PairPrices scaled(3, EdgeModel::SCALED_MAXIMUM);
  scaled.setPairwise(0, 1, 1000);
  scaled.setScale(1, 0, 32768);
  EXPECT_EQ(scaled.scale(0, 1), 32768) << "a pair has no order";
  EXPECT_EQ(scaled.price(0, 1, 100), 1000U) << "max(pairwise, scale * weight)";
  EXPECT_EQ(scaled.price(0, 1, 6000), 3000U) << "max(pairwise, scale * weight)";
  EXPECT_EQ(scaled.price(0, 1, PairPrices::NO_EDGE), 0U) << "no edge, no price";
}

TEST(PairPricesTest, LeastPairwiseIgnoresTheDiagonal)
{
  PairPrices prices(3);
  prices.setPairwise(0, 1, 30);
  prices.setPairwise(0, 2, 20);
  prices.setPairwise(1, 2, 40);
  EXPECT_EQ(prices.leastPairwise(), 20);
  EXPECT_EQ(PairPrices(1).leastPairwise(), PairPrices::NO_EDGE) << "one label, no pair";
}

class LayoutTest : public testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Widths, LayoutTest,
                         testing::Values(1, 2, 3, 31, 32, 63, 64, 65, 66, 127, 640));

TEST_P(LayoutTest, EverySiteHasAPlaceOfItsOwnWithRoomForVectorsAround)
{
  const CheckerboardLayout layout(GetParam(), 3);
  for (int colour = 0; colour < 2; ++colour) {
    std::set<std::size_t> places;
    int sites = 0;
    for (int y = 0; y < 3; ++y) {
      EXPECT_EQ(layout.sitesInRow(y, colour) + layout.sitesInRow(y, 1 - colour),
                GetParam())
          << "every site has one colour";
      sites += layout.sitesInRow(y, colour);
      for (int x = 0; x < GetParam(); ++x)
        if ((x + y) % 2 == colour)
          places.insert(layout.rowStart(y) + static_cast<std::size_t>(x / 2));
      EXPECT_EQ(CheckerboardLayout::firstColumn(y, colour), (y + colour) % 2);
      // A vector that starts at the last site and is stored one element further on.
      EXPECT_LE(layout.rowStart(y) +
                    static_cast<std::size_t>(layout.sitesInRow(y, colour)) +
                    CheckerboardLayout::PADDING,
                layout.bufferSize(y + 1))
          << "vectors would reach into the next row";
    }
    EXPECT_EQ(places.size(), static_cast<std::size_t>(sites))
        << "two sites share a place";
  }
}

TEST(GridFieldTest, KeepsWhatIsSetAtEverySite)
{
  scenes::Random random(1);
  for (const EdgeModel model : {EdgeModel::SOFT_THRESHOLD, EdgeModel::SCALED_MAXIMUM}) {
    const GridField field = reference::randomField(random, 35, 6, 4, model);
    const GridField copy(field);
    const FieldRows& rows = field;
    const GridField by_rows(rows);
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 35; ++x) {
        for (int l = 0; l < 4; ++l) {
          EXPECT_EQ(by_rows.data(x, y, l), field.data(x, y, l)) << "fillRow loses data";
          EXPECT_EQ(copy.data(x, y, l), field.data(x, y, l));
        }
        EXPECT_EQ(by_rows.rightEdge(x, y), field.rightEdge(x, y)) << "fillRow: right";
        EXPECT_EQ(by_rows.downEdge(x, y), field.downEdge(x, y)) << "fillRow: down";
      }
    EXPECT_EQ(by_rows.edgeModel(), model);
  }
}

TEST(GridFieldTest, StartsWithoutEdgesAndCosts)
{
  const GridField field(5, 4, 2);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(field.rightEdge(x, y), GridField::NO_EDGE);
      EXPECT_EQ(field.downEdge(x, y), GridField::NO_EDGE);
      EXPECT_EQ(field.data(x, y, 1), 0);
    }
}

TEST(GridFieldTest, EnergyIsTheSumOfCostsAndPrices)
{
  scenes::Random random(2);
  for (const EdgeModel model : {EdgeModel::SOFT_THRESHOLD, EdgeModel::SCALED_MAXIMUM})
    for (int round = 0; round < 10; ++round) {
      const GridField field =
          reference::randomField(random, 1 + round, 11 - round, 3, model);
      reference::Labels labels;
      for (int i = 0; i < field.width() * field.height(); ++i)
        labels.push_back(static_cast<std::uint16_t>(random.integer(0, 2)));
      EXPECT_EQ(field.energy(labels), static_cast<std::uint64_t>(reference::energyOf(
                                          reference::GridProblem(field), labels)))
          << "size " << field.width() << " x " << field.height();
    }
}

} // namespace
} // namespace pcl_mrf_planes
