// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"
#include "reference/plane_fit.h"

#include <pcl_mrf_planes/tile_plane_detection.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace pcl_mrf_planes {
namespace {

/// A wall that faces the sensor, sampled like a camera does.
OrganizedPoints wall(int width, int height, float depth = 2.0f)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      points.set(static_cast<std::size_t>(y * width + x),
                 0.004f * static_cast<float>(x), 0.004f * static_cast<float>(y), depth);
  return points;
}

Parameters tilesOf(int width, int height)
{
  Parameters p;
  p.tile_width = width;
  p.tile_height = height;
  return p;
}

struct Shape {
  int width, height, tile_width, tile_height;
};

class TileShapeTest : public testing::TestWithParam<Shape> {};

TEST_P(TileShapeTest, EveryValidPointIsCountedOnceInItsTile)
{
  const Shape shape = GetParam();
  scenes::Random random(4);
  const OrganizedPoints points =
      reference::randomPoints(random, shape.width, shape.height, 0.7);
  const TileImage image =
      detectTilePlanes(points, tilesOf(shape.tile_width, shape.tile_height));
  EXPECT_EQ(image.columns, (shape.width - 1) / shape.tile_width + 1);
  EXPECT_EQ(image.rows, (shape.height - 1) / shape.tile_height + 1);
  ASSERT_EQ(image.tiles.size(), static_cast<std::size_t>(image.columns * image.rows));
  std::vector<ScatterMatrix> expected(image.tiles.size());
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) {
      const auto i = static_cast<std::size_t>(y * shape.width + x);
      ASSERT_LT(image.tileAt(x, y), image.tiles.size());
      if (points.valid[i] != 0)
        expected[image.tileAt(x, y)].add(points.x[i], points.y[i], points.z[i]);
    }
  for (std::size_t t = 0; t < expected.size(); ++t) {
    EXPECT_EQ(image.tiles[t].sums.n, expected[t].n)
        << "tile " << t << " missed points or counted some twice";
    EXPECT_LE((image.tiles[t].sums.matrix() - expected[t].matrix()).norm(),
              1e-12 * (1.0 + expected[t].matrix().norm()))
        << "the ten sums of tile " << t << " are not those of its points";
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, TileShapeTest,
                         testing::Values(Shape{80, 40, 40, 40}, Shape{83, 47, 40, 40},
                                         Shape{1, 1, 40, 40}, Shape{1, 100, 40, 40},
                                         Shape{100, 1, 40, 40}, Shape{7, 5, 40, 40},
                                         Shape{64, 48, 2, 2}, Shape{65, 33, 16, 8},
                                         Shape{65, 33, 3, 50}, Shape{39, 41, 40, 40}));

TEST(TilePlaneDetectionTest, FitsAreThoseOfTheReference)
{
  const auto frame =
      reference::takePicture("room", 160, 120, 3, scenes::SensorNoise::kinect());
  const OrganizedPoints points = reference::toPoints(frame);
  for (const PlaneFit fit : {PlaneFit::ALGEBRAIC, PlaneFit::GEOMETRIC}) {
    Parameters parameters = tilesOf(20, 20);
    parameters.fit = fit;
    const TileImage image = detectTilePlanes(points, parameters);
    std::vector<reference::Points> members(image.tiles.size());
    for (int y = 0; y < points.height; ++y)
      for (int x = 0; x < points.width; ++x) {
        const auto i = static_cast<std::size_t>(y * points.width + x);
        if (points.valid[i] != 0)
          members[image.tileAt(x, y)].emplace_back(points.x[i], points.y[i],
                                                   points.z[i]);
      }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < members.size(); ++t) {
      const TilePlane& tile = image.tiles[t];
      if (members[t].size() < 200) {
        EXPECT_EQ(tile.state, TileState::TOO_FEW) << "half of the points must be valid";
        continue;
      }
      const reference::Fit expected = fit == PlaneFit::ALGEBRAIC
                                          ? reference::fitAlgebraic(members[t])
                                          : reference::fitGeometric(members[t]);
      ASSERT_TRUE(tile.fit.valid) << "tile " << t;
      EXPECT_NEAR(tile.fit.rms, expected.rms, 1e-7) << "tile " << t;
      EXPECT_NEAR(tile.fit.plane.d, expected.plane[3], 1e-5) << "tile " << t;
      EXPECT_GT(tile.fit.plane.normal.dot(expected.plane.head<3>()), 1.0 - 1e-10)
          << "tile " << t;
      const double depth = reference::mean(members[t]).z();
      EXPECT_NEAR(tile.depth, depth, 1e-9) << "sigma is taken at the centroid's depth";
      EXPECT_EQ(tile.kept(), expected.rms <= 1.425e-3 * depth * depth)
          << "low fit-error means below the sensor's noise, tile " << t;
      kept += tile.kept() ? 1U : 0U;
    }
    EXPECT_EQ(image.countKept(), kept);
    EXPECT_GT(kept, 5U) << "the scene must show some planes for this test to mean much";
  }
}

TEST(TilePlaneDetectionTest, StateSaysWhatBecameOfATile)
{
  // Four tiles: a wall, a line, a wall with too many holes, a step.
  OrganizedPoints points = wall(80, 20);
  const auto at = [](int x, int y) { return static_cast<std::size_t>(y * 80 + x); };
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x) {
      points.set(at(20 + x, y), 0.01f * static_cast<float>(20 * y + x), 0.0f, 2.0f);
      if ((x + y) % 2 == 0 || x == 0)
        points.clear(at(40 + x, y));
      points.set(at(60 + x, y), 0.01f * static_cast<float>(x),
                 0.01f * static_cast<float>(y), (x * y) % 3 == 0 ? 2.0f : 2.5f);
    }
  const TileImage image = detectTilePlanes(points, tilesOf(20, 20));
  ASSERT_EQ(image.tiles.size(), 4U);
  EXPECT_EQ(image.tiles[0].state, TileState::KEPT) << "a wall is a plane";
  EXPECT_EQ(image.tiles[1].state, TileState::DEGENERATE) << "a line is no plane";
  EXPECT_EQ(image.tiles[2].state, TileState::TOO_FEW) << "less than half is valid";
  EXPECT_EQ(image.tiles[3].state, TileState::BAD_FIT) << "depth jumps are no plane";
  EXPECT_EQ(image.countKept(), 1U);
}

TEST(TilePlaneDetectionTest, OneRowOrColumnOfPixelsHasNoPlane)
{
  // The rays of a row or a column of pixels lie on a plane through the sensor, whatever
  // is measured along them: it fits without error, wins every merge and means nothing.
  const auto frame =
      reference::takePicture("room", 81, 61, 3, scenes::SensorNoise::kinect());
  const TileImage image = detectTilePlanes(reference::toPoints(frame), tilesOf(20, 20));
  ASSERT_EQ(image.columns, 5);
  ASSERT_EQ(image.rows, 4);
  for (int row = 0; row < 4; ++row)
    EXPECT_FALSE(image.tiles[static_cast<std::size_t>(row * 5 + 4)].kept())
        << "the ragged tile of one column was kept, row " << row;
  for (int column = 0; column < 5; ++column)
    EXPECT_FALSE(image.tiles[static_cast<std::size_t>(15 + column)].kept())
        << "the ragged tile of one row was kept, column " << column;
}

TEST(TilePlaneDetectionTest, ValidShareIsInclusiveAndOfTheRaggedTile)
{
  for (const int removed : {49, 50, 51}) {
    OrganizedPoints points = wall(10, 10);
    for (int i = 0; i < removed; ++i)
      points.clear(static_cast<std::size_t>(i));
    const TileImage image = detectTilePlanes(points, tilesOf(40, 40));
    EXPECT_EQ(image.tiles[0].kept(), removed <= 50)
        << removed << " of 100 points removed: a ragged tile counts by its own area";
  }
  Parameters all = tilesOf(10, 10);
  all.min_valid_share = 1.0;
  OrganizedPoints points = wall(10, 10);
  EXPECT_TRUE(detectTilePlanes(points, all).tiles[0].kept());
  points.clear(55);
  EXPECT_FALSE(detectTilePlanes(points, all).tiles[0].kept()) << "one hole is too much";
  all.min_valid_share = 0.0;
  EXPECT_TRUE(detectTilePlanes(points, all).tiles[0].kept());
  OrganizedPoints nothing;
  nothing.resize(10, 10);
  EXPECT_EQ(detectTilePlanes(nothing, all).tiles[0].state, TileState::TOO_FEW)
      << "no points are too few even when no share is asked for";
}

TEST(TilePlaneDetectionTest, MultiplierAndDepthMoveTheThreshold)
{
  OrganizedPoints points = wall(20, 20);
  scenes::Random random(8);
  for (float& z : points.z)
    z += static_cast<float>(0.01 * random.normal());
  Parameters parameters = tilesOf(20, 20);
  parameters.fit = PlaneFit::GEOMETRIC;
  parameters.noise = NoiseModel::fixed(1.0);
  const double rms = detectTilePlanes(points, parameters).tiles[0].fit.rms;
  EXPECT_NEAR(rms, 0.01, 0.002);
  parameters.noise_multiplier = rms * 1.0001;
  EXPECT_TRUE(detectTilePlanes(points, parameters).tiles[0].kept());
  parameters.noise_multiplier = rms * 0.9999;
  EXPECT_FALSE(detectTilePlanes(points, parameters).tiles[0].kept())
      << "the threshold is the multiplier times sigma";
  points.depth_measure = DepthMeasure::RANGE;
  parameters.noise = {0.0, 1.0, 0.0};
  const TileImage image = detectTilePlanes(points, parameters);
  EXPECT_NEAR(image.tiles[0].depth, image.tiles[0].sums.centroid().norm(), 1e-12)
      << "for a lidar the depth is the range";
}

TEST(TilePlaneDetectionTest, ThreadsGiveTheSameBits)
{
  scenes::Random random(12);
  const OrganizedPoints points = reference::randomPoints(random, 203, 151);
  Parameters parameters = tilesOf(10, 10);
  parameters.noise = NoiseModel::none();
  const TileImage one = detectTilePlanes(points, parameters);
  for (const unsigned int threads : {0U, 2U, 3U, 8U, 40U}) {
    parameters.number_of_threads = threads;
    const TileImage many = detectTilePlanes(points, parameters);
    ASSERT_EQ(many.tiles.size(), one.tiles.size());
    for (std::size_t t = 0; t < one.tiles.size(); ++t) {
      EXPECT_EQ(many.tiles[t].fit.plane.normal, one.tiles[t].fit.plane.normal)
          << threads << " threads give other bits in tile " << t;
      EXPECT_EQ(many.tiles[t].fit.plane.d, one.tiles[t].fit.plane.d);
      EXPECT_EQ(many.tiles[t].fit.rms, one.tiles[t].fit.rms);
      EXPECT_EQ(many.tiles[t].state, one.tiles[t].state);
    }
  }
}

} // namespace
} // namespace pcl_mrf_planes
