// SPDX-License-Identifier: BSD-3-Clause
//
// Method::ADAPTIVE on inputs of hostile shape and with parameters at the ends of their ranges.
#include "expect_sound.h"
#include "reference/inputs.h"

#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

using scenes::SensorNoise;

/// A wall 2 m away, of any size.
OrganizedPoints wall(int width, int height)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      points.set(static_cast<std::size_t>(v * width + u),
                 0.004f * static_cast<float>(u - width / 2),
                 0.004f * static_cast<float>(v - height / 2), 2.0f);
  return points;
}

/// Every point by a function of its place in the image.
OrganizedPoints made(int width, int height,
                     const std::function<Eigen::Vector3f(int, int)>& at)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const Eigen::Vector3f p = at(u, v);
      points.set(static_cast<std::size_t>(v * width + u), p.x(), p.y(), p.z());
    }
  return points;
}

std::map<std::string, OrganizedPoints> hostileInputs()
{
  std::map<std::string, OrganizedPoints> inputs;
  const std::vector<std::pair<int, int>> sizes = {
      {1, 1}, {1, 97}, {97, 1}, {2, 2}, {7, 5}, {9, 8}, {3, 300}, {300, 3}, {65, 33}};
  for (const auto& size : sizes)
    inputs["wall of " + std::to_string(size.first) + "x" +
           std::to_string(size.second)] = wall(size.first, size.second);
  using Eigen::Vector3f;
  inputs["no valid point"] = made(64, 48, [](int, int) {
    return Vector3f::Constant(reference::NOT_MEASURED).eval();
  });
  inputs["all points equal"] =
      made(64, 48, [](int, int) { return Vector3f(0.1f, 0.2f, 1.5f); });
  inputs["all points at the sensor"] =
      made(64, 48, [](int, int) { return Vector3f(0, 0, 0); });
  inputs["all points on a line"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u + v), 0.3f, 2.0f);
  });
  inputs["a plane through the sensor"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u), 0.0f,
                    1.0f + 0.01f * static_cast<float>(v));
  });
  inputs["1e5 m away"] = made(64, 48, [](int u, int v) {
    return Vector3f(200.0f * static_cast<float>(u - 32),
                    200.0f * static_cast<float>(v - 24), 1e5f);
  });
  inputs["of 1e-6 m"] = made(64, 48, [](int u, int v) {
    return Vector3f(1e-8f * static_cast<float>(u - 32),
                    1e-8f * static_cast<float>(v - 24), 1e-6f);
  });
  inputs["from 1e-6 m to 1e6 m"] = made(64, 48, [](int u, int v) {
    const float z = std::pow(10.0f, static_cast<float>((u * 7 + v * 5) % 13 - 6));
    return Vector3f(0.001f * static_cast<float>(u) * z,
                    0.001f * static_cast<float>(v) * z, z);
  });
  inputs["behind the sensor"] = made(64, 48, [](int u, int v) {
    return Vector3f(0.01f * static_cast<float>(u), 0.01f * static_cast<float>(v),
                    -2.0f);
  });
  scenes::Random random(5);
  inputs["no shape at all"] = reference::randomPoints(random, 70, 50);
  OrganizedPoints room = reference::toPoints(
      reference::takePicture("room", 125, 93, 6, SensorNoise::kinect()));
  inputs["a room"] = room;
  for (int i = 0; i < 125 * 93; ++i)
    if ((i % 125 + i / 125) % 2 == 0)
      room.clear(static_cast<std::size_t>(i));
  inputs["a checkerboard of holes"] = room;
  for (auto& input : inputs)
    input.second.resolveDepthMeasure(DepthMeasure::AUTO);
  return inputs;
}

std::map<std::string, AdaptiveParameters> extremeParameters()
{
  std::map<std::string, AdaptiveParameters> all;
  all["as they are"] = {};
  all["8 levels"].levels = 8;
  all["tiles of 32 points only"].smallest_level = 3;
  all["support from afar"].support_reach = 512;
  all["noise as stated"].estimate_noise = false;
  all["2 levels"].levels = 2;
  all["no passes"].passes = 0;
  all["30 passes"].passes = 30;
  all["1 round"].rounds = 1;
  all["10 rounds"].rounds = 10;
  all["no fans"].fan_parts = 0;
  all["fans of two"].fan_parts = 2;
  all["no joining"].join_coplanar = false;
  all["occluders separate"].join_over_occluders = false;
  AdaptiveParameters& greedy = all["takes everything"];
  greedy.tile_tolerance = greedy.merge_tolerance = greedy.region_tolerance = 1e6;
  greedy.accept_tolerance = greedy.join_tolerance = 1e6;
  greedy.min_fill = 0;
  greedy.min_points = 1;
  greedy.min_evidence = 0;
  greedy.join_gap = 1e4;
  greedy.join_seen = 1;
  greedy.local_reach = 16;
  AdaptiveParameters& choosy = all["takes next to nothing"];
  choosy.tile_tolerance = choosy.merge_tolerance = choosy.region_tolerance = 1e-6;
  choosy.accept_tolerance = choosy.join_tolerance = 1e-6;
  choosy.min_fill = 1;
  choosy.min_points = 1;
  choosy.local_reach = 0;
  AdaptiveParameters& shreds = all["tiles never merge"];
  shreds.merge_tolerance = 1e-6;
  shreds.min_points = 1;
  shreds.min_evidence = 0;
  shreds.fan_parts = 0;
  for (const double cost : {1e-6, 1e3})
    for (const double change : {0.0, 1e3}) {
      AdaptiveParameters& p =
          all["none " + std::to_string(cost) + ", change " + std::to_string(change)];
      p.none_cost = cost;
      p.label_change = change;
    }
  AdaptiveParameters& least = all["least noise"];
  least.noise_percentile = least.growth_percentile = least.local_percentile = 0;
  least.flatness = least.max_flatness = 0;
  least.min_sigma = 1e-9;
  least.max_growth = least.long_range = least.max_local = 1;
  least.step_sigmas = 1e-6;
  AdaptiveParameters& most = all["most noise"];
  most.noise_percentile = most.growth_percentile = most.local_percentile = 1;
  most.flatness = most.max_flatness = most.min_sigma = 1e6;
  most.max_growth = most.long_range = most.max_local = 1e6;
  most.step_sigmas = most.min_evidence = 1e6;
  // Times the squared growth of the noise: more than an int holds.
  AdaptiveParameters& no_points = all["no plane is large enough"];
  no_points.min_points = 1000000000;
  no_points.min_evidence = 0;
  no_points.max_growth = no_points.long_range = 1e6;
  return all;
}

TEST(AdaptiveHostileTest, NoInputAndNoParametersBreakIt)
{
  const auto inputs = hostileInputs();
  for (const auto& choice : extremeParameters()) {
    Parameters parameters;
    parameters.adaptive = choice.second;
    ASSERT_EQ(parameters.validate(), "") << choice.first;
    for (const auto& input : inputs) {
      SCOPED_TRACE(input.first + ", " + choice.first);
      const PlaneSegmentation result = segmentPlanes(input.second, parameters);
      expectSound(input.second, result);
      EXPECT_TRUE(result.regions.empty() || choice.first != "no plane is large enough");
    }
  }
}

TEST(AdaptiveHostileTest, MorePlanesThanLabelsAreRefused)
{
  constexpr int SIDE = 4; // points of a cell, each a plane
  const auto steps = [](int columns, int rows) {
    return made(SIDE * columns, SIDE * rows, [=](int u, int v) {
      const int column = u / SIDE;
      const int row = v / SIDE;
      const float z = 2.0f + 0.5f * static_cast<float>((column + 2 * row) % 5);
      return Eigen::Vector3f(0.002f * z * static_cast<float>(u - SIDE / 2 * columns),
                             0.002f * z * static_cast<float>(v - SIDE / 2 * rows), z);
    });
  };
  Parameters parameters;
  parameters.adaptive.min_points = 3;
  parameters.adaptive.min_evidence = 0;
  parameters.adaptive.join_coplanar = false;
  parameters.adaptive.estimate_noise =
      false; // larger tiles would show nothing but steps
  parameters.noise = NoiseModel::fixed(0.0001);
  EXPECT_EQ(segmentPlanes(steps(20, 20), parameters).report.planes_after_merging, 400U);
  try {
    segmentPlanes(steps(256, 255), parameters);
    FAIL() << "65280 planes have no labels of 16 bits";
  }
  catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("65000 planes"), std::string::npos);
  }
}

TEST(AdaptiveHostileTest, WhatIsNoPlaneGetsNone)
{
  const auto inputs = hostileInputs();
  for (const char* name : {"no valid point", "no shape at all", "wall of 1x1",
                           "wall of 2x2", "wall of 1x97", "wall of 97x1"})
    EXPECT_TRUE(segmentPlanes(inputs.at(name), Parameters()).regions.empty()) << name;
  for (const char* name : {"1e5 m away", "behind the sensor"}) {
    const PlaneSegmentation result = segmentPlanes(inputs.at(name), Parameters());
    EXPECT_EQ(result.regions.size(), 1U) << name;
    EXPECT_GE(result.report.labelled_share, 0.99) << name;
  }
}

} // namespace
} // namespace pcl_mrf_planes
