// SPDX-License-Identifier: BSD-3-Clause
//
// Stages of the adaptive method that judge regions, each alone, against their definitions.
#include "adaptive/candidate_field.h"
#include "adaptive/curved_surfaces.h"
#include "adaptive/region_graph.h"
#include "reference/inputs.h"

#include <pcl_mrf_planes/region_contour.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::adaptive {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Noise that is the same at each distance and for each size.
NoiseLaw whiteNoise(double sigma)
{
  NoiseLaw noise;
  noise.a = sigma;
  noise.growth = {1.0};
  return noise;
}

TileSums sumsOf(const Points& points, double sigma)
{
  TileSums sums;
  for (const Eigen::Vector3d& p : points) {
    sums.add(p.x(), p.y(), p.z());
    sums.noise += sigma * sigma;
  }
  return sums;
}

double squaredDistances(const FittedPlane& plane, const Points& points)
{
  double sum = 0;
  for (const Eigen::Vector3d& p : points)
    sum += std::pow(plane.distance(p), 2);
  return sum;
}

/// So many points of a wall that leans by \a slope.
Points wallPoints(scenes::Random& random, int count, double left, double slope)
{
  Points points;
  for (int k = 0; k < count; ++k) {
    const double x = left + random.uniform(0, 1);
    points.emplace_back(x, random.uniform(0, 1),
                        2 + slope * x + 0.01 * random.normal());
  }
  return points;
}

TEST(RegionStagesTest, APlaneNeedsSoManyPointsHoweverFlat)
{
  scenes::Random random(1);
  const AdaptiveParameters parameters;
  const Points points = wallPoints(random, 200, 0, 0.1);
  const FittedPlane plane = fitSums(sumsOf(points, 0.01));
  const NoiseLaw noise = whiteNoise(0.01);
  EXPECT_TRUE(isPlane(plane, 200, noise, parameters));
  EXPECT_FALSE(isPlane(plane, 201, noise, parameters)) << "too few points";
  FittedPlane rough = plane;
  rough.mse *= 100;
  EXPECT_FALSE(isPlane(rough, 200, noise, parameters)) << "too far from flat";
}

TEST(RegionStagesTest, DissimilarityIsWhatTheSmallerPartDeviatesInTheJointPlane)
{
  scenes::Random random(2);
  AdaptiveParameters parameters;
  parameters.region_tolerance = 1000; // the joint plane is flat enough
  const NoiseLaw noise = whiteNoise(0.01);
  for (const auto& [small, large] : {std::pair{50, 60}, {40, 400}, {30, 3000}}) {
    const Points a = wallPoints(random, small, 0, 0.1);
    const Points b = wallPoints(random, large, 1, 0.3);
    Points both = a;
    both.insert(both.end(), b.begin(), b.end());
    const FittedPlane plane_a = fitSums(sumsOf(a, 0.01));
    const FittedPlane plane_b = fitSums(sumsOf(b, 0.01));
    const FittedPlane joint = fitSums(sumsOf(both, 0.01));
    const double growth = squaredDistances(joint, both) - squaredDistances(plane_a, a) -
                          squaredDistances(plane_b, b);
    const double expected = growth / small / allowedVariance(joint, noise, parameters);
    EXPECT_NEAR(dissimilarity(plane_a, plane_b, joint, noise, parameters), expected,
                1e-6 * expected);
    EXPECT_NEAR(dissimilarity(plane_b, plane_a, joint, noise, parameters), expected,
                1e-6 * expected)
        << "parts have no order";
  }
}

/// Steps from a block to the nearest cell of a region, diagonal ones count as one.
int stepsTo(int region, const TileRegions& regions, const TileLevel& cells, int column,
            int row)
{
  constexpr int CELLS = CandidateBlocks::SIDE / CELL;
  int least = INT_MAX;
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c)
      if (regions.cell_region[cells.at(c, r)] == region)
        for (int v = row * CELLS; v < (row + 1) * CELLS; ++v)
          for (int u = column * CELLS; u < (column + 1) * CELLS; ++u)
            least = std::min(least, std::max(std::abs(u - c), std::abs(v - r)));
  return least;
}

TEST(RegionStagesTest, PairsThatCostTheSameComeInTheOrderOfTheirNumbers)
{
  const std::vector<Candidate> in_order = {
      {1.0, 5, 6, 0}, {2.0, 1, 2, 0}, {2.0, 1, 3, 0}, {2.0, 2, 3, 0}, {3.0, 0, 1, 0}};
  for (std::size_t i = 0; i < in_order.size(); ++i)
    for (std::size_t j = 0; j < in_order.size(); ++j)
      EXPECT_EQ(in_order[j] < in_order[i], i < j) << i << " before " << j;
}

TEST(RegionStagesTest, CandidatesAreTheRegionsInReachTheNearestFirst)
{
  scenes::Random random(3);
  for (int run = 0; run < 60; ++run) {
    TileLevel cells;
    cells.side = CELL;
    cells.columns = random.integer(1, 11);
    cells.rows = random.integer(1, 9);
    const int reach = random.integer(0, 4);
    const int ids = random.integer(1, 12);
    TileRegions regions;
    const double empty = random.uniform(0, 1);
    for (std::size_t k = 0; k < cells.at(0, cells.rows); ++k)
      regions.cell_region.push_back(random.chance(empty) ? -1
                                                         : random.integer(0, ids - 1));
    const CandidateBlocks blocks =
        findCandidates(regions, cells, cells.columns * CELL, cells.rows * CELL, reach);
    for (int row = 0; row < blocks.rows; ++row)
      for (int column = 0; column < blocks.columns; ++column) {
        std::vector<std::pair<int, int>> near;
        for (int id = 0; id < ids; ++id)
          if (const int steps = stepsTo(id, regions, cells, column, row);
              steps <= reach)
            near.emplace_back(steps, id);
        std::sort(near.begin(), near.end());
        std::vector<int> expected = {0};
        for (const auto& [steps, id] : near)
          if (expected.size() < CandidateBlocks::SLOTS)
            expected.push_back(id + 1);
        const std::size_t block = blocks.at(column, row);
        const std::uint16_t* labels = blocks.labelsOf(block);
        EXPECT_EQ(std::vector<int>(labels, labels + blocks.count[block]), expected)
            << "block " << column << ", " << row << " of run " << run;
      }
  }
}

/// A flat wall of so many points.
OrganizedPoints wall(int width, int height)
{
  OrganizedPoints points;
  points.fill(width, height, [&](std::size_t i) {
    return Eigen::Vector3f(
        0.01f * static_cast<float>(i % static_cast<std::size_t>(width)),
        0.01f * static_cast<float>(i / static_cast<std::size_t>(width)), 2.0f);
  });
  return points;
}

/// The plane of that wall for two labels.
FittedRegions wallTwice()
{
  FittedPlane plane;
  plane.normal = {0, 0, -1};
  plane.d = 2;
  plane.centroid = {0, 0, 2};
  plane.extent = 0.3;
  plane.n = 1000;
  FittedRegions regions;
  regions.add(plane, {});
  regions.add(plane, {});
  return regions;
}

TEST(RegionStagesTest, SmallPartsLoseTheirLabelAndLargeOnesKeepIt)
{
  constexpr int WIDTH = 96;
  constexpr int HEIGHT = 70;
  AdaptiveParameters parameters;
  parameters.min_points = 60;
  const OrganizedPoints points = wall(WIDTH, HEIGHT);
  const auto pyramid = buildTilePyramid(points, parameters);
  scenes::Random random(4);
  std::size_t dropped = 0;
  for (int run = 0; run < 10; ++run) {
    std::vector<std::uint16_t> labels(points.size(), 0);
    for (int k = 0; k < 60; ++k) {
      const int left = random.integer(0, WIDTH - 14);
      const int top = random.integer(0, HEIGHT - 14);
      const int right = left + random.integer(1, k < 6 ? 14 : 8);
      const int bottom = top + random.integer(1, k < 6 ? 14 : 8);
      for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
          labels[static_cast<std::size_t>(y * WIDTH + x)] =
              static_cast<std::uint16_t>(k % 3);
    }
    const ConnectedParts parts = findConnectedParts(labels, WIDTH, HEIGHT);
    LabelledPoints image(labels, WIDTH);
    refineRegions(points, pyramid, wallTwice(), whiteNoise(0.01), parameters, image);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] == 0) {
        EXPECT_EQ(image.at(i), 0);
        continue;
      }
      const int size = parts.size[static_cast<std::size_t>(parts.part_of_point[i])];
      ASSERT_EQ(image.at(i) != 0, size >= parameters.min_points)
          << "a part of " << size << " points in run " << run;
      dropped += size < parameters.min_points ? 1U : 0U;
    }
  }
  EXPECT_GT(dropped, 0U) << "the test needs small parts";
}

TEST(RegionStagesTest, NewNumbersOfLabelsAreThoseOfAllTheirPoints)
{
  constexpr int WIDTH = 33;
  constexpr int LABELS = 9;
  scenes::Random random(12);
  for (int run = 0; run < 20; ++run) {
    std::vector<std::uint16_t> labels(WIDTH * std::size_t{17});
    for (std::size_t i = 0; i < labels.size(); ++i)
      labels[i] = i > 0 && random.chance(0.8)
                      ? labels[i - 1]
                      : static_cast<std::uint16_t>(random.integer(0, LABELS));
    LabelledPoints image(labels, WIDTH);
    for (int times = 0; times < 3; ++times) {
      // As planes are dropped: those that stay move up.
      FrameVector<std::uint16_t> id(LABELS + 1, 0);
      std::uint16_t kept = 0;
      for (std::size_t label = 1; label < id.size(); ++label)
        id[label] = random.chance(0.7) ? ++kept : std::uint16_t{0};
      image.renumber(id);
      for (std::uint16_t& label : labels)
        label = id[label];
      for (std::size_t i = 0; i < labels.size(); ++i)
        ASSERT_EQ(image.at(i), labels[i]) << "point " << i << ", run " << run;
      for (const LabelRun& piece : image.runs.runs)
        for (std::size_t i = piece.begin; i < piece.end; ++i)
          ASSERT_EQ(piece.label, labels[i]) << "run of point " << i;
    }
    image.write();
    EXPECT_EQ(image.labels, labels);
    EXPECT_EQ(image.at(0), labels[0]) << "the numbers are the names now";
  }
}

/// What is left of a wall with one label, some of whose points are half a metre in front.
FittedRegions refinedWall(int in_front)
{
  constexpr int SIDE = 80;
  OrganizedPoints points = wall(SIDE, SIDE);
  for (int k = 0; k < in_front; ++k) {
    const std::size_t i = static_cast<std::size_t>(k) * 37 % points.size();
    points.set(i, points.x[i], points.y[i], 1.5F);
  }
  const AdaptiveParameters parameters;
  const auto pyramid = buildTilePyramid(points, parameters);
  LabelledPoints image(std::vector<std::uint16_t>(points.size(), 1), SIDE);
  return refineRegions(points, pyramid, wallTwice(), whiteNoise(1e-4), parameters,
                       image);
}

TEST(RegionStagesTest, AFewPointsInFrontDoNotSpoilAPlane)
{
  for (const int in_front : {0, 1, 3, 60}) {
    const FittedRegions regions = refinedWall(in_front);
    ASSERT_EQ(regions.planes.size(), 1U) << in_front << " of 6400 points";
    EXPECT_NEAR(regions.planes[0].mse, 0, 1e-8);
    EXPECT_NEAR(regions.planes[0].d, 2, 1e-5);
    EXPECT_EQ(regions.planes[0].n, 6400 - in_front);
    EXPECT_EQ(regions.sums[0].n, 6400 - in_front);
  }
  EXPECT_TRUE(refinedWall(70).planes.empty()) << "more than one in a hundred";
}

/// A patch of a floor a metre below, far ahead, and around it what \a goes_on tells: the
/// same floor without a label, or nothing measured.
bool keepsPatch(bool goes_on)
{
  constexpr int SIDE = 60;
  OrganizedPoints points;
  points.resize(SIDE, SIDE);
  std::vector<std::uint16_t> labels(points.size(), 0);
  Points patch;
  for (int y = 0; y < SIDE; ++y)
    for (int x = 0; x < SIDE; ++x) {
      const auto i = static_cast<std::size_t>(y * SIDE + x);
      const bool inside = std::min(x, y) >= 10 && std::max(x, y) < 50;
      if (!inside && !goes_on)
        continue;
      points.set(i, 0.02f * static_cast<float>(x - SIDE / 2), 1.0f,
                 6.0f - 0.02f * static_cast<float>(y));
      labels[i] = inside ? 1 : 0;
      if (inside)
        patch.emplace_back(points.x[i], points.y[i], points.z[i]);
    }
  AdaptiveParameters parameters;
  parameters.fan_share = 1; // no region is too large for a facet
  FittedRegions regions;
  regions.add(fitSums(sumsOf(patch, 0.01)), sumsOf(patch, 0.01));
  LabelledPoints image(labels, SIDE);
  dropDoubtfulPlanes(points, whiteNoise(0.01), parameters, regions, image);
  return regions.planes.size() == 1;
}

TEST(RegionStagesTest, APlaneThatEndsWhereNothingIsMeasuredIsNoFacet)
{
  EXPECT_TRUE(keepsPatch(false)) << "what is not measured is no surface that goes on";
  EXPECT_FALSE(keepsPatch(true)) << "the surface goes on, but is no plane";
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
