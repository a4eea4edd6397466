// SPDX-License-Identifier: BSD-3-Clause
//
// Which planes are dropped as parts of a surface that turns all around them.
#include "adaptive/curved_surfaces.h"
#include "adaptive/surrounded_facets.h"
#include "scenes/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <vector>

namespace pcl_mrf_planes::adaptive {
namespace {

constexpr int SIDE = 120; ///< of the image, points
constexpr int INNER = 40; ///< of the plane in its middle
constexpr int PARTS = 5;  ///< it, and what is left, right, above and below of it
constexpr double STEP = 0.005;
constexpr double SIGMA = 0.001;

/// How the parts around the middle lean, as dz/dx and dz/dy per distance from it.
struct Lean {
  double sideways, upright;
};

/// The part of the image that a point lies in, 0 for the one in the middle.
int partOf(int x, int y)
{
  const int u = x - SIDE / 2, v = y - SIDE / 2;
  if (std::max(std::abs(u), std::abs(v)) < INNER / 2)
    return 0;
  if (std::abs(u) > std::abs(v))
    return u < 0 ? 1 : 2;
  return v < 0 ? 3 : 4;
}

/// A flat square 2 m ahead, and four surfaces that lean away from it.
class Dome {
public:
  /// \param[in] has which parts are seen
  explicit Dome(const Lean& lean, const std::function<bool(int)>& has)
  : labels_(static_cast<std::size_t>(SIDE * SIDE), 0)
  {
    points_.resize(SIDE, SIDE);
    scenes::Random random(7);
    std::vector<TileSums> sums(PARTS);
    for (int y = 0; y < SIDE; ++y)
      for (int x = 0; x < SIDE; ++x)
        if (const int part = partOf(x, y); has(part))
          add(x, y, part, lean, SIGMA * random.normal(),
              sums[static_cast<std::size_t>(part)]);
    std::vector<std::uint16_t> id(PARTS + 1, 0);
    for (std::size_t part = 0; part < sums.size(); ++part)
      if (sums[part].n > 0) {
        regions_.add(fitSums(sums[part]), sums[part]);
        id[part + 1] = static_cast<std::uint16_t>(regions_.planes.size());
      }
    for (std::uint16_t& label : labels_)
      label = id[label];
  }

  /// Whether the plane in the middle is kept.
  bool keepsMiddle(const AdaptiveParameters& parameters) const
  {
    NoiseLaw noise;
    noise.a = SIGMA;
    noise.growth = {1.0};
    FittedRegions regions = regions_;
    LabelledPoints image(labels_, SIDE);
    dropDoubtfulPlanes(points_, noise, parameters, regions, image);
    const std::size_t middle = (SIDE / 2) * SIDE + SIDE / 2;
    return image.at(middle) != 0;
  }

private:
  void add(int x, int y, int part, const Lean& lean, double noise, TileSums& sums)
  {
    const auto beyond = [](int from_middle) {
      return std::max(0, std::abs(from_middle) - INNER / 2) * STEP;
    };
    const double z = 2 + noise +
                     (part == 1 || part == 2   ? lean.sideways * beyond(x - SIDE / 2)
                      : part == 3 || part == 4 ? lean.upright * beyond(y - SIDE / 2)
                                               : 0.0);
    const auto i = static_cast<std::size_t>(y * SIDE + x);
    points_.set(i, static_cast<float>(STEP * (x - SIDE / 2)),
                static_cast<float>(STEP * (y - SIDE / 2)), static_cast<float>(z));
    sums.add(points_.x[i], points_.y[i], points_.z[i]);
    sums.noise += SIGMA * SIGMA;
    labels_[i] = static_cast<std::uint16_t>(part + 1);
  }

  OrganizedPoints points_;
  FittedRegions regions_;
  std::vector<std::uint16_t> labels_;
};

/// Parts are larger than facets, but not too large for what is surrounded.
AdaptiveParameters largerThanFacets()
{
  AdaptiveParameters parameters;
  parameters.fan_share = 0.1;
  return parameters;
}

bool isAny(int)
{
  return true;
}
bool isInRow(int part)
{
  return part < 3;
}

constexpr Lean SHALLOW = {0.25, 0.25}; // 14 degrees
constexpr Lean STEEP = {0.8, 0.8};     // 39 degrees
constexpr Lean MIXED = {0.25, 0.8};
constexpr Lean FLAT_ABOVE = {0.25, 0.0};

TEST(SurroundedFacetsTest, APlaneInsideOfAPillowIsPartOfIt)
{
  EXPECT_FALSE(Dome(SHALLOW, isAny).keepsMiddle(largerThanFacets()));
}

TEST(SurroundedFacetsTest, SwitchedOffItStays)
{
  AdaptiveParameters parameters = largerThanFacets();
  parameters.fan_ring = 2;
  EXPECT_TRUE(Dome(SHALLOW, isAny).keepsMiddle(parameters));
  parameters.fan_ring = 0.9;
  parameters.fan_parts = 0;
  EXPECT_TRUE(Dome(SHALLOW, isAny).keepsMiddle(parameters)) << "no fans at all";
}

TEST(SurroundedFacetsTest, ThePlaneOfABoxWithSharpEdgesStays)
{
  EXPECT_TRUE(Dome(STEEP, isAny).keepsMiddle(largerThanFacets()));
}

TEST(SurroundedFacetsTest, APlaneThatAlsoHasSharpEdgesStays)
{
  EXPECT_TRUE(Dome(MIXED, isAny).keepsMiddle(largerThanFacets()));
}

TEST(SurroundedFacetsTest, TheSideOfAPrismStays)
{
  EXPECT_TRUE(Dome(SHALLOW, isInRow).keepsMiddle(largerThanFacets()))
      << "it turns in one direction only, though nothing else is around it";
}

TEST(SurroundedFacetsTest, ANoisyPlaneAloneStays)
{
  EXPECT_TRUE(Dome(SHALLOW, [](int part) {
                return part == 0;
              }).keepsMiddle(largerThanFacets()));
}

TEST(SurroundedFacetsTest, ALargePlaneStaysWhateverIsAroundIt)
{
  AdaptiveParameters parameters = largerThanFacets();
  parameters.fan_share = 0.03; // of which three times are less than the middle
  EXPECT_TRUE(Dome(SHALLOW, isAny).keepsMiddle(parameters));
}

/// Whether each region is surrounded, the first with a fold of 10 points to each other one.
std::vector<bool> surroundedBy(const std::vector<Eigen::Vector3d>& normals,
                               double least_share, int goes_on = 0, int open = 0)
{
  FittedRegions regions;
  RegionBorders borders;
  FrameVector<Fold> folds;
  const auto add = [&](const Eigen::Vector3d& normal) {
    FittedPlane plane;
    plane.normal = normal.normalized();
    regions.add(plane, {});
    borders.open.push_back(0);
    borders.goes_on.push_back(0);
  };
  add({0, 0, 1});
  for (std::size_t k = 0; k < normals.size(); ++k) {
    add(normals[k]);
    borders.between[{0, static_cast<int>(k + 1)}].length = 10;
    folds.push_back({0, k + 1, 10});
  }
  borders.open[0] = open;
  borders.goes_on[0] = goes_on;
  const FrameVector<bool> found =
      findSurroundedFacets(regions, borders, folds, least_share);
  return {found.begin(), found.end()};
}

TEST(SurroundedFacetsTest, CountsTheShareOfTheBorderThatGoesOn)
{
  const std::vector<Eigen::Vector3d> around = {
      {0.2, 0, 1}, {-0.2, 0, 1}, {0, 0.2, 1}, {0, -0.2, 1}};
  EXPECT_TRUE(surroundedBy(around, 1.0)[0]);
  EXPECT_FALSE(surroundedBy(around, 1.01)[0]);
  EXPECT_TRUE(surroundedBy(around, 0.8, 0, 10)[0]) << "40 of 50 points";
  EXPECT_FALSE(surroundedBy(around, 0.81, 0, 10)[0]);
  EXPECT_TRUE(surroundedBy(around, 0.9, 5, 10)[0]) << "45 of 50 points";
  EXPECT_FALSE(surroundedBy(around, 0.91, 5, 10)[0]);
  EXPECT_FALSE(surroundedBy({}, 0.0)[0]) << "nothing is around it";
}

TEST(SurroundedFacetsTest, TurnsInOneDirectionAreAPrismsHoweverItLies)
{
  for (const double angle : {0.0, 0.4, 0.8, 1.3}) {
    const Eigen::Vector3d way(0.2 * std::cos(angle), 0.2 * std::sin(angle), 0);
    const Eigen::Vector3d across(-way.y(), way.x(), 0);
    const Eigen::Vector3d up(0, 0, 1);
    EXPECT_FALSE(surroundedBy({up + way, up - way}, 0.9)[0]);
    EXPECT_TRUE(surroundedBy({up + way, up - way, up + across}, 0.9)[0]);
  }
}

TEST(SurroundedFacetsTest, WhatLiesFlatBesideItIsNoTurn)
{
  EXPECT_TRUE(Dome(FLAT_ABOVE, isAny).keepsMiddle(largerThanFacets()));
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
