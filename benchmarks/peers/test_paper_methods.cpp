// SPDX-License-Identifier: BSD-3-Clause
//
// The methods that we wrote from their papers: on scenes whose planes are known, on clouds
// without any, and the fit that they stand on.
#include "image_parts.h"
#include "peer_list.h"
#include "plane_patch.h"

#include "reference/clouds.h"
#include "scenes/random.h"
#include "scenes/scene_library.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {
namespace {

struct Method {
  Peer peer;
  Setting setting;
};

void PrintTo(const Method& method, std::ostream* to)
{
  *to << method.peer.name << ", " << method.setting.name;
}

std::vector<Method> methods()
{
  std::vector<Method> all;
  for (const Peer& peer : {makePeac(), makeCape(), makePlanarPatches()})
    for (const Setting& setting : peer.settings)
      all.push_back({peer, setting});
  return all;
}

std::string nameOf(const testing::TestParamInfo<Method>& info)
{
  return info.param.peer.name + '_' + info.param.setting.name;
}

class PaperMethod : public testing::TestWithParam<Method> {
protected:
  Labels segment(const Cloud::ConstPtr& cloud) const
  {
    double milliseconds = -1.0;
    Labels labels =
        GetParam().peer.segment(cloud, GetParam().setting.values, milliseconds);
    EXPECT_GE(milliseconds, 0.0) << "the time was not taken";
    return labels;
  }
};

/// The label that holds most of the largest connected part of a true plane: these methods
/// give other parts labels of their own.
struct Match {
  std::uint16_t label = 0;
  double found = 0.0; ///< share of the part's points that carry the label
  double right = 0.0; ///< share of the label's points that lie on the plane
};

std::vector<std::size_t> largestPart(const scenes::SceneFrame& truth,
                                     std::uint16_t plane)
{
  std::vector<std::uint8_t> mask;
  for (const std::uint16_t label : truth.labels)
    mask.push_back(label == plane);
  const auto parts = connectedParts(mask, static_cast<std::size_t>(truth.width), 1);
  return *std::max_element(
      parts.begin(), parts.end(),
      [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

Match matchOf(const scenes::SceneFrame& truth, std::uint16_t plane,
              const std::vector<std::size_t>& part, const Labels& labels)
{
  std::map<std::uint16_t, double> of_part;
  for (const std::size_t i : part)
    of_part[labels[i]] += 1.0;
  of_part.erase(0);
  Match match;
  for (const auto& [label, points] : of_part)
    if (points > of_part[match.label])
      match.label = label;
  double all = 0.0, on_plane = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (match.label != 0 && labels[i] == match.label) {
      all += 1.0;
      on_plane += truth.labels[i] == plane;
    }
  match.found = of_part[match.label] / static_cast<double>(part.size());
  match.right = all > 0.0 ? on_plane / all : 0.0;
  return match;
}

/// Every plane with a part of at least so many points has a label of its own.
void expectLargePlanesFound(const scenes::SceneFrame& truth, const Labels& labels,
                            std::size_t min_points, double share)
{
  std::vector<std::uint16_t> used;
  const auto planes = static_cast<std::uint16_t>(truth.planes.size());
  for (std::uint16_t plane = 1; plane <= planes; ++plane) {
    const std::vector<std::size_t> part = largestPart(truth, plane);
    if (part.size() < min_points)
      continue;
    const Match match = matchOf(truth, plane, part, labels);
    EXPECT_GE(match.found, share) << "plane " << plane << " is cut or lost";
    EXPECT_GE(match.right, share) << "plane " << plane << " swallows others";
    EXPECT_EQ(std::count(used.begin(), used.end(), match.label), 0)
        << "plane " << plane << " shares its label";
    used.push_back(match.label);
  }
  EXPECT_GE(used.size(), 2u) << "the scene does not test much";
}

/// At a quarter of the points: a tree of neighbours takes long.
scenes::SceneFrame pictureOf(scenes::View view, const scenes::SensorNoise& noise)
{
  view.camera.resize(320, 240);
  return scenes::render(view.scene, view.camera, noise, 1);
}

TEST_P(PaperMethod, FindsFloorAndWallsOfACorner)
{
  const scenes::SceneFrame truth =
      pictureOf(scenes::corner(), scenes::SensorNoise::gaussian(0.001));
  expectLargePlanesFound(truth, segment(reference::toCloud<pcl::PointXYZ>(truth)), 1,
                         0.9);
}

TEST_P(PaperMethod, KeepsParallelWallsApart)
{
  const scenes::SceneFrame truth =
      pictureOf(scenes::step(0.3), scenes::SensorNoise::gaussian(0.001));
  expectLargePlanesFound(truth, segment(reference::toCloud<pcl::PointXYZ>(truth)), 1,
                         0.9);
}

/// Normals of 30 neighbours do not stand a Kinect's noise.
scenes::SensorNoise bearableNoise(const Peer& peer)
{
  return peer.name == "planar_patches" ? scenes::SensorNoise::gaussian(0.001)
                                       : scenes::SensorNoise::kinect(0.5);
}

TEST_P(PaperMethod, FindsFloorAndWallsOfARoomThroughNoise)
{
  const scenes::SceneFrame truth =
      pictureOf(scenes::makeRoom(1), bearableNoise(GetParam().peer));
  expectLargePlanesFound(truth, segment(reference::toCloud<pcl::PointXYZ>(truth)),
                         truth.size() / 10, 0.8);
}

TEST_P(PaperMethod, LabelsNoPointWithoutDepth)
{
  const scenes::SceneFrame truth =
      pictureOf(scenes::makeRoom(2), scenes::SensorNoise::kinect());
  const Labels labels = segment(reference::toCloud<pcl::PointXYZ>(truth));
  for (std::size_t i = 0; i < labels.size(); ++i)
    ASSERT_TRUE(truth.valid(i) || labels[i] == 0) << "point " << i;
}

TEST_P(PaperMethod, IsTheSameOnEveryCall)
{
  const auto cloud = reference::toCloud<pcl::PointXYZ>(
      pictureOf(scenes::makeRoom(3), scenes::SensorNoise::kinect()));
  EXPECT_EQ(segment(cloud), segment(cloud));
}

TEST_P(PaperMethod, HasNoPlanesWithoutPoints)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [width, height] : {std::pair(1u, 1u), {7u, 90u}, {64u, 48u}}) {
    const Cloud::Ptr cloud(new Cloud(width, height, pcl::PointXYZ(nan, nan, nan)));
    EXPECT_EQ(segment(cloud), Labels(cloud->size(), 0)) << width << " x " << height;
  }
}

INSTANTIATE_TEST_SUITE_P(All, PaperMethod, testing::ValuesIn(methods()), nameOf);

/// Points about a plane, out of the plane by noise of this size.
PlanePatch scatteredPatch(scenes::Random& random, double noise)
{
  const Eigen::Vector3d normal =
      Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  PlanePatch patch;
  for (int k = 0; k < 100; ++k) {
    Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    p += (noise * random.normal() - normal.dot(p)) * normal;
    p.z() += 3.0;
    patch.sums.add(p.x(), p.y(), p.z());
  }
  patch.fit();
  return patch;
}

TEST(PlanePatch, AgreesWithTheEigenvaluesOfTheCovariance)
{
  scenes::Random random(1);
  for (const double noise : {0.0, 1e-4, 0.01, 0.5})
    for (int k = 0; k < 50; ++k) {
      const PlanePatch patch = scatteredPatch(random, noise);
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> reference(
          patch.sums.covariance());
      const Eigen::Vector3d& variances = reference.eigenvalues();
      EXPECT_NEAR(patch.mse, variances[0], 1e-9 * variances[2] + 1e-6 * variances[0]);
      EXPECT_NEAR(std::abs(patch.normal.dot(reference.eigenvectors().col(0))), 1.0,
                  1e-6);
      EXPECT_LE(patch.normal.dot(patch.centre), 0.0) << "turned away from the sensor";
      if (noise > 0.0) {
        EXPECT_NEAR(patch.flatness * variances[0] / variances[1], 1.0, 1e-4);
      }
      EXPECT_EQ(patch.mse, meanSquaredDistance(patch.sums));
    }
}

} // namespace
} // namespace pcl_mrf_planes::benchmarks
