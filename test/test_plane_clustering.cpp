// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"
#include "reference/merging.h"

#include <pcl_mrf_planes/plane_clustering.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace pcl_mrf_planes {
namespace {

constexpr double BETA = 0.4;
constexpr double V = 0.15;

/// Noisy copies of a few planes, as the tiles of a room give, and some that are alone.
std::vector<PlaneModel> randomModels(std::uint64_t seed, int count)
{
  scenes::Random random(seed);
  std::vector<Plane> walls;
  for (int i = 0; i < 6; ++i)
    walls.push_back(reference::randomPlane(random));
  std::vector<PlaneModel> models;
  for (int i = 0; i < count; ++i) {
    PlaneModel model;
    if (random.chance(0.3))
      model.plane = reference::randomPlane(random);
    else {
      model.plane = walls[static_cast<std::size_t>(random.integer(0, 5))];
      const double spread = random.uniform(0.0, 0.3);
      model.plane.normal += spread * reference::randomUnit(random);
      model.plane.normal.normalize();
      model.plane.d += spread * random.normal();
      model.plane.orientTowardsOrigin();
    }
    model.error = random.uniform(1e-3, 2e-2);
    model.points = random.integer(800, 1600);
    models.push_back(model);
  }
  return models;
}

bool samePlane(const Plane& p, const Plane& q)
{
  return p.normal == q.normal && p.d == q.d;
}

double supportOf(const std::vector<PlaneModel>& models)
{
  return std::accumulate(
      models.begin(), models.end(), 0.0,
      [](double sum, const PlaneModel& m) { return sum + m.points; });
}

class ClusteringSeedTest : public testing::TestWithParam<int> {
protected:
  std::vector<PlaneModel> models_ =
      randomModels(static_cast<std::uint64_t>(GetParam()), 10 + 12 * GetParam());
};

INSTANTIATE_TEST_SUITE_P(Seeds, ClusteringSeedTest, testing::Range(0, 16));

TEST_P(ClusteringSeedTest, EveryRemainingPairIsAtLeastTheThresholdApart)
{
  for (const double threshold : {0.02, V, 0.6}) {
    const PlaneClusters clusters = mergePlanes(models_, BETA, threshold);
    for (std::size_t i = 0; i < clusters.planes.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GE(
            dissimilarity(clusters.planes[i].plane, clusters.planes[j].plane, BETA),
            threshold)
            << "equation (9) relies on v for all pairs of labels";
  }
}

TEST_P(ClusteringSeedTest, AssignmentPoolsThePointsAndWinnersKeepTheirCoefficients)
{
  const PlaneClusters clusters = mergePlanes(models_, BETA, V);
  ASSERT_EQ(clusters.assignment.size(), models_.size());
  std::vector<double> support(clusters.planes.size(), 0.0);
  std::vector<std::size_t> best(clusters.planes.size(), models_.size());
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const int a = clusters.assignment[i];
    ASSERT_GE(a, 0) << "every plane must refer to one that remains";
    ASSERT_LT(a, static_cast<int>(clusters.planes.size()));
    const auto label = static_cast<std::size_t>(a);
    support[label] += models_[i].points;
    if (best[label] == models_.size() || models_[i].error < models_[best[label]].error)
      best[label] = i;
  }
  for (std::size_t l = 0; l < clusters.planes.size(); ++l) {
    EXPECT_EQ(clusters.planes[l].points, support[l]) << "points got lost, plane " << l;
    ASSERT_LT(best[l], models_.size()) << "nothing refers to plane " << l;
    EXPECT_TRUE(samePlane(clusters.planes[l].plane, models_[best[l]].plane))
        << "the plane with the smallest error must keep its coefficients, plane " << l;
    EXPECT_EQ(clusters.planes[l].error, models_[best[l]].error);
    if (l > 0) {
      EXPECT_LE(clusters.planes[l].points, clusters.planes[l - 1].points)
          << "best supported first";
    }
  }
  EXPECT_EQ(supportOf(clusters.planes), supportOf(models_));
}

TEST_P(ClusteringSeedTest, TheOrderOfTheInputHasNoSay)
{
  const PlaneClusters expected = mergePlanes(models_, BETA, V);
  scenes::Random random(99);
  for (int round = 0; round < 5; ++round) {
    std::vector<std::size_t> order(models_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(
          order[i - 1],
          order[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
    std::vector<PlaneModel> shuffled;
    for (const std::size_t i : order)
      shuffled.push_back(models_[i]);
    const PlaneClusters clusters = mergePlanes(shuffled, BETA, V);
    ASSERT_EQ(clusters.planes.size(), expected.planes.size())
        << "another order gave another number of planes";
    for (std::size_t l = 0; l < expected.planes.size(); ++l)
      EXPECT_TRUE(samePlane(clusters.planes[l].plane, expected.planes[l].plane))
          << "another order gave another plane " << l;
    for (std::size_t i = 0; i < order.size(); ++i)
      EXPECT_EQ(clusters.assignment[i], expected.assignment[order[i]])
          << "another order sent a plane elsewhere";
  }
}

TEST_P(ClusteringSeedTest, AgreesWithThePlainReference)
{
  std::vector<reference::MergedPlane> plain;
  for (const PlaneModel& m : models_) {
    Eigen::Vector4d plane;
    plane << m.plane.normal, m.plane.d;
    plain.push_back({plane, m.error, m.points, {plain.size()}});
  }
  const auto expected = reference::mergePlanes(plain, BETA, V);
  const PlaneClusters clusters = mergePlanes(models_, BETA, V);
  ASSERT_EQ(clusters.planes.size(), expected.size());
  for (std::size_t l = 0; l < expected.size(); ++l) {
    EXPECT_EQ(clusters.planes[l].plane.d, expected[l].plane[3]) << "plane " << l;
    EXPECT_EQ(clusters.planes[l].points, expected[l].points) << "plane " << l;
    for (const std::size_t member : expected[l].members)
      EXPECT_EQ(clusters.assignment[member], static_cast<int>(l))
          << "plane " << member << " refers to another one than in the reference";
  }
}

PlaneModel modelAt(double offset, double error, double points = 100)
{
  return {{-Eigen::Vector3d::UnitZ(), offset}, error, points};
}

TEST(PlaneClusteringTest, TheSmallerErrorWins)
{
  for (const bool first_is_better : {true, false}) {
    const double e0 = first_is_better ? 1e-3 : 5e-3;
    const double e1 = first_is_better ? 5e-3 : 1e-3;
    const PlaneClusters c =
        mergePlanes({modelAt(2.0, e0, 10), modelAt(2.1, e1, 1000)}, BETA, V);
    ASSERT_EQ(c.planes.size(), 1U) << "10 cm apart is the same plane";
    EXPECT_EQ(c.planes[0].plane.d, first_is_better ? 2.0 : 2.1)
        << "the error decides, not the number of points";
    EXPECT_EQ(c.planes[0].points, 1010.0);
  }
}

TEST(PlaneClusteringTest, TheThresholdItselfSeparates)
{
  // beta |d_i - d_j| = 0.15 exactly representable: 0.5 * 0.25 = 0.125.
  const std::vector<PlaneModel> two = {modelAt(2.0, 1e-3), modelAt(2.25, 1e-3)};
  EXPECT_EQ(mergePlanes(two, 0.5, 0.125).planes.size(), 2U) << "(5) says less than v";
  EXPECT_EQ(mergePlanes(two, 0.5, 0.1251).planes.size(), 1U);
}

TEST(PlaneClusteringTest, NothingOneAndZeroThreshold)
{
  const PlaneClusters nothing = mergePlanes({}, BETA, V);
  EXPECT_TRUE(nothing.planes.empty());
  EXPECT_TRUE(nothing.assignment.empty());
  const PlaneClusters one = mergePlanes({modelAt(1.0, 1e-3, 7)}, BETA, V);
  ASSERT_EQ(one.planes.size(), 1U);
  EXPECT_EQ(one.assignment, std::vector<int>{0});
  EXPECT_EQ(one.planes[0].points, 7.0);
  const auto models = randomModels(3, 50);
  EXPECT_EQ(mergePlanes(models, BETA, 0.0).planes.size(), models.size())
      << "v = 0 merges nothing";
  EXPECT_EQ(mergePlanes(models, BETA, 1e6).planes.size(), 1U)
      << "a boundless v merges everything";
}

TEST(PlaneClusteringTest, DuplicatesBecomeOne)
{
  const std::vector<PlaneModel> same(30, modelAt(1.5, 1e-3, 10));
  const PlaneClusters clusters = mergePlanes(same, BETA, V);
  ASSERT_EQ(clusters.planes.size(), 1U);
  EXPECT_EQ(clusters.planes[0].points, 300.0);
  EXPECT_EQ(std::set<int>(clusters.assignment.begin(), clusters.assignment.end()),
            std::set<int>{0});
}

TEST(PlaneClusteringTest, TilesThatWereNotKeptReferToNothing)
{
  const auto frame =
      reference::takePicture("room", 160, 120, 2, scenes::SensorNoise::kinect());
  Parameters parameters;
  parameters.tile_width = parameters.tile_height = 10;
  const TileImage image = detectTilePlanes(reference::toPoints(frame), parameters);
  const PlaneClusters all = clusterTilePlanes(image, parameters);
  ASSERT_EQ(all.assignment.size(), image.tiles.size())
      << "the tile-to-plane map has an entry for every tile";
  ASSERT_GT(all.planes.size(), 2U) << "the scene is too simple for this test";
  double kept_points = 0.0;
  for (std::size_t t = 0; t < image.tiles.size(); ++t) {
    EXPECT_EQ(all.assignment[t] != PlaneClusters::NONE, image.tiles[t].kept())
        << "tile " << t;
    kept_points += image.tiles[t].kept() ? image.tiles[t].sums.n : 0.0;
  }
  EXPECT_EQ(supportOf(all.planes), kept_points);

  parameters.max_planes = 2;
  const PlaneClusters two = clusterTilePlanes(image, parameters);
  ASSERT_EQ(two.planes.size(), 2U);
  for (std::size_t l = 0; l < 2; ++l)
    EXPECT_TRUE(samePlane(two.planes[l].plane, all.planes[l].plane))
        << "max_planes must keep the best supported ones";
  for (std::size_t t = 0; t < image.tiles.size(); ++t)
    EXPECT_EQ(two.assignment[t],
              all.assignment[t] < 2 ? all.assignment[t] : PlaneClusters::NONE)
        << "tiles of dropped planes refer to nothing";
}

} // namespace
} // namespace pcl_mrf_planes
