// SPDX-License-Identifier: BSD-3-Clause
#include "reference/inputs.h"
#include "reference/plane_fit.h"

#include "region_gathering.h"

#include <pcl_mrf_planes/plane_regions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace pcl_mrf_planes {
namespace {

/// A rectangle of known size, turned about the vertical, seen by a camera.
scenes::SceneFrame rectangle(double angle, double width, double height,
                             const scenes::SensorNoise& noise)
{
  scenes::Scene scene;
  scene.beginObject();
  const Eigen::Vector3d across(std::cos(angle) * width, std::sin(angle) * width, 0.0);
  const Eigen::Vector3d up(0.0, 0.0, height);
  const Eigen::Vector3d corner = Eigen::Vector3d(0, 2.5, 0) - across / 2 - up / 2;
  scene.addPolygon({corner, corner + across, corner + across + up, corner + up},
                   scenes::Colour(0.5, 0.5, 0.5));
  scenes::Camera camera = scenes::lookAt({0, 0, 0}, {0, 1, 0});
  camera.resize(1280, 960);
  return scenes::render(scene, camera, noise, 1);
}

class AreaTest : public testing::TestWithParam<double> {};

INSTANTIATE_TEST_SUITE_P(Angles, AreaTest, testing::Values(0.0, 0.3, -0.6, 0.9, 1.1));

TEST_P(AreaTest, OfARectangleSeenObliquelyIsKnown)
{
  const auto frame = rectangle(GetParam(), 1.2, 1.0, scenes::SensorNoise::none());
  const OrganizedPoints points = reference::toPoints(frame);
  ASSERT_EQ(frame.planes.size(), 1U);
  const Plane plane = {frame.planes[0].head<3>(), frame.planes[0][3]};
  const auto regions =
      gatherRegions(points, {plane}, std::vector<std::uint16_t>(points.size(), 0), 0);
  ASSERT_EQ(regions.size(), 1U);
  // Pixels are points: half a pixel is missing along each border.
  EXPECT_NEAR(regions[0].area, 1.2, 0.01 * 1.2)
      << "more than 1 % off at " << GetParam() << " rad";
  EXPECT_EQ(regions[0].indices.size(), points.countValid());
  EXPECT_LT(regions[0].rms, 1e-5) << "points of the plane have no distance to it";
}

TEST(PlaneRegionsTest, NoiseHardlyChangesTheArea)
{
  const auto clean = rectangle(0.5, 1.2, 1.0, scenes::SensorNoise::none());
  const auto noisy = rectangle(0.5, 1.2, 1.0, scenes::SensorNoise::gaussian(0.02));
  const Plane plane = {clean.planes[0].head<3>(), clean.planes[0][3]};
  const std::vector<std::uint16_t> labels(clean.size(), 0);
  const double expected =
      gatherRegions(reference::toPoints(clean), {plane}, labels, 0)[0].area;
  const double found =
      gatherRegions(reference::toPoints(noisy), {plane}, labels, 0)[0].area;
  EXPECT_NEAR(found, expected, 0.03 * expected)
      << "2 cm of noise between points 2 mm apart must cancel";
}

TEST(PlaneRegionsTest, RunsAndSumsThatAreKnownGiveTheSame)
{
  scenes::Random random(8);
  const OrganizedPoints points = reference::randomPoints(random, 41, 23, 0.9);
  std::vector<Plane> planes;
  for (int i = 0; i < 5; ++i)
    planes.push_back(reference::randomPlane(random));
  std::vector<std::uint16_t> labels;
  FrameVector<ScatterMatrix> sums(planes.size());
  std::uint16_t label = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (random.chance(0.3))
      label = static_cast<std::uint16_t>(random.integer(0, 5));
    const bool on_plane = points.valid[i] != 0 && label < planes.size();
    labels.push_back(on_plane ? label : NO_PLANE);
    if (on_plane)
      sums[label].add(points.x[i], points.y[i], points.z[i]);
  }
  const LabelRuns runs = findRuns(labels, points.width, NO_PLANE);
  RegionMemory memory = {planes, {}, 0};
  std::vector<PlaneRegion> regions; // those of the round before leave their memory
  for (const int least : {0, 100, 60, 100}) {
    const auto expected = gatherRegions(points, planes, labels, least);
    gatherRegions(points, runs, sums, least, 0.0, 1, memory, regions);
    ASSERT_EQ(regions.size(), expected.size());
    for (std::size_t k = 0; k < regions.size(); ++k) {
      EXPECT_EQ(regions[k].label, expected[k].label);
      EXPECT_EQ(regions[k].indices, expected[k].indices);
      EXPECT_EQ(regions[k].area, expected[k].area);
      EXPECT_NEAR(regions[k].rms, expected[k].rms, 1e-9);
      EXPECT_LT((regions[k].centroid - expected[k].centroid).norm(), 1e-9);
      EXPECT_LT((regions[k].covariance - expected[k].covariance).norm(), 1e-9);
    }
    std::vector<std::uint16_t> image(points.size(), 0);
    paintRegions(runs, regions, planes.size(), image);
    EXPECT_EQ(image, regionLabels(points, expected)) << "least " << least;
  }
}

TEST(PlaneRegionsTest, StatisticsAreThoseOfThePoints)
{
  scenes::Random random(3);
  const OrganizedPoints points = reference::randomPoints(random, 31, 23);
  std::vector<Plane> planes;
  for (int i = 0; i < 4; ++i)
    planes.push_back(reference::randomPlane(random));
  std::vector<std::uint16_t> labels;
  std::map<int, reference::Points> members;
  std::map<int, std::vector<int>> indices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    labels.push_back(static_cast<std::uint16_t>(random.integer(0, 2))); // none has 3
    if (points.valid[i] != 0) {
      members[labels[i]].emplace_back(points.x[i], points.y[i], points.z[i]);
      indices[labels[i]].push_back(static_cast<int>(i));
    }
  }
  const auto regions = gatherRegions(points, planes, labels, 0);
  ASSERT_EQ(regions.size(), 3U) << "a label without points gives no region";
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const PlaneRegion& region = regions[k];
    const reference::Points& mine = members[region.label];
    EXPECT_EQ(region.indices, indices[region.label]) << "ascending points of the label";
    EXPECT_EQ(region.plane.d, planes[static_cast<std::size_t>(region.label)].d);
    EXPECT_LT((region.centroid - reference::mean(mine)).norm(), 1e-9);
    const Eigen::MatrixXd c = reference::centred(mine);
    EXPECT_LT((region.covariance - c.transpose() * c / static_cast<double>(mine.size()))
                  .norm(),
              1e-9)
        << "covariance about the centroid, divided by n";
    double sum = 0.0;
    for (const auto& p : mine)
      sum += std::pow(region.plane.distance(p), 2);
    EXPECT_NEAR(region.rms, std::sqrt(sum / static_cast<double>(mine.size())), 1e-9);
    if (k > 0) {
      EXPECT_LE(region.area, regions[k - 1].area) << "largest area first";
    }
  }
  const auto image = regionLabels(points, regions);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.valid[i] == 0) {
      EXPECT_EQ(image[i], 0) << "a point that was not measured has no label";
    }
    else {
      EXPECT_EQ(regions[image[i] - 1U].label, labels[i]) << "point " << i;
    }
  }
}

TEST(PlaneRegionsTest, SmallRegionsAreDropped)
{
  OrganizedPoints points;
  points.resize(10, 1);
  for (std::size_t i = 0; i < 10; ++i)
    points.set(i, static_cast<float>(i), 0, 1);
  const std::vector<std::uint16_t> labels = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1};
  scenes::Random random(1);
  const std::vector<Plane> planes = {reference::randomPlane(random),
                                     reference::randomPlane(random)};
  EXPECT_EQ(gatherRegions(points, planes, labels, 3).size(), 2U);
  const auto large = gatherRegions(points, planes, labels, 4);
  ASSERT_EQ(large.size(), 1U) << "3 points are fewer than 4";
  EXPECT_EQ(large[0].label, 0);
  EXPECT_EQ(large[0].area, 0.0) << "a single row has no area";
  EXPECT_EQ(regionLabels(points, large),
            (std::vector<std::uint16_t>{1, 1, 1, 1, 1, 1, 1, 0, 0, 0}));
  EXPECT_TRUE(gatherRegions(points, planes, labels, 8).empty());
}

TEST(PlaneRegionsTest, RegionsOfLittleAreaAreDropped)
{
  const auto frame = rectangle(0.0, 1.2, 1.0, scenes::SensorNoise::none());
  const Plane plane = {frame.planes[0].head<3>(), frame.planes[0][3]};
  const std::vector<std::uint16_t> labels(frame.size(), 0);
  const OrganizedPoints points = reference::toPoints(frame);
  EXPECT_EQ(gatherRegions(points, {plane}, labels, 0, 1.15).size(), 1U);
  EXPECT_TRUE(gatherRegions(points, {plane}, labels, 0, 1.25).empty()) << "1.2 m^2";
}

/// Face by face: whole squares and triangles of neighbouring points.
double areaFaceByFace(const OrganizedPoints& points, const Plane& plane,
                      const std::vector<std::uint16_t>& labels, std::uint16_t label)
{
  const auto w = static_cast<std::size_t>(points.width);
  const auto at = [&](std::size_t i) {
    return Eigen::Vector3d(points.x[i], points.y[i], points.z[i]);
  };
  double twice = 0.0;
  for (std::size_t a = 0; a + w + 1 < points.size(); ++a) {
    if (a % w + 1 == w)
      continue;
    std::vector<Eigen::Vector3d> loop; // clockwise
    for (const std::size_t i : {a, a + 1, a + w + 1, a + w})
      if (points.valid[i] != 0 && labels[i] == label)
        loop.push_back(at(i));
    if (loop.size() >= 3)
      for (std::size_t k = 1; k + 1 < loop.size(); ++k)
        twice += plane.normal.dot((loop[k] - loop[0]).cross(loop[k + 1] - loop[0]));
  }
  return std::abs(twice) / 2;
}

// The area is added up along borders; face by face must give the same, whatever the shape.
TEST(PlaneRegionsTest, AreasOfRaggedRegionsAreThoseOfTheirFaces)
{
  scenes::Random random(8);
  for (int k = 0; k < 60; ++k) {
    const int width = random.integer(1, 24);
    const int height = random.integer(1, 20);
    OrganizedPoints points;
    points.resize(width, height);
    std::vector<std::uint16_t> labels;
    const double same = random.uniform(0.3, 0.99); // as the point before
    for (int i = 0; i < width * height; ++i) {
      if (!random.chance(0.05))
        points.set(static_cast<std::size_t>(i),
                   static_cast<float>(i % width + random.uniform(-0.3, 0.3)),
                   static_cast<float>(i / width + random.uniform(-0.3, 0.3)), 20.0f);
      labels.push_back(i > 0 && random.chance(same)
                           ? labels.back()
                           : static_cast<std::uint16_t>(random.integer(0, 2)));
    }
    const std::vector<Plane> planes = {reference::randomPlane(random),
                                       reference::randomPlane(random),
                                       reference::randomPlane(random)};
    for (const PlaneRegion& region : gatherRegions(points, planes, labels, 0)) {
      const auto label = static_cast<std::uint16_t>(region.label);
      EXPECT_NEAR(region.area, areaFaceByFace(points, planes[label], labels, label),
                  1e-9)
          << width << "x" << height << ", label " << label << ", image " << k;
    }
  }
}

} // namespace
} // namespace pcl_mrf_planes
