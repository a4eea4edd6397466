// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <set>
#include <stdexcept>
#include <string>

namespace {

using namespace pcl_mrf_planes::scenes;

constexpr double PI = 3.14159265358979323846;

View smallView(const std::string& name, int width = 160, int height = 120,
               std::uint64_t seed = 3)
{
  View view = makeScene(name, seed);
  view.camera.resize(width, height);
  return view;
}

SceneFrame take(const View& view, const SensorNoise& noise = SensorNoise::none(),
                std::uint64_t seed = 0)
{
  return render(view.scene, view.camera, noise, seed);
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b)
{
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

std::size_t countValid(const SceneFrame& frame)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < frame.size(); ++i)
    count += frame.valid(i) ? 1 : 0;
  return count;
}

/// Checks what must hold of every frame; the distance to the planes is left to callers.
void expectConsistent(const SceneFrame& frame)
{
  ASSERT_EQ(frame.size(), static_cast<std::size_t>(frame.width * frame.height));
  for (const Eigen::Vector4d& plane : frame.planes) {
    EXPECT_NEAR(plane.head<3>().norm(), 1.0, 1e-12) << "a normal is no unit vector";
    EXPECT_GE(plane[3], 0.0) << "a normal points away from the sensor";
  }
  for (std::size_t i = 0; i < frame.size(); ++i) {
    ASSERT_LE(frame.labels[i], frame.planes.size()) << "a label without a plane";
    ASSERT_TRUE(frame.valid(i) || frame.labels[i] == 0)
        << "an invalid point has a label";
    ASSERT_EQ(std::isnan(frame.x[i]), std::isnan(frame.z[i]));
  }
  const std::vector<std::size_t> counts = frame.labelCounts();
  for (std::size_t k = 1; k < counts.size(); ++k)
    EXPECT_GT(counts[k], 0u) << "plane " << k << " is listed but does not show";
}

class EveryScene : public testing::TestWithParam<std::string> {};

TEST_P(EveryScene, ExactPointsLieOnTheirPlane)
{
  for (const bool lidar : {false, true}) {
    View view = smallView(GetParam());
    if (lidar)
      view.camera.makeLidar(256, 32);
    const SceneFrame frame = take(view);
    expectConsistent(frame);
    ASSERT_FALSE(frame.planes.empty());
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame.labels[i] == 0)
        continue;
      const Eigen::Vector3d p(frame.x[i], frame.y[i], frame.z[i]);
      const Eigen::Vector4d& plane = frame.planes[frame.labels[i] - 1u];
      ASSERT_NEAR(plane.head<3>().dot(p) + plane[3], 0.0, 1e-5 * p.norm())
          << "pixel " << i << ", label " << frame.labels[i];
    }
  }
}

TEST_P(EveryScene, KinectFrameIsConsistentAndPlausible)
{
  const SceneFrame frame = take(smallView(GetParam()), SensorNoise::kinect(), 5);
  expectConsistent(frame);
  EXPECT_GT(countValid(frame), frame.size() / 2) << "the noise leaves too little";
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (!frame.valid(i))
      continue;
    ASSERT_GT(frame.z[i], 0.45f);
    ASSERT_LT(frame.z[i], 9.0f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryScene, testing::ValuesIn(sceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(Scenes, RoomsAreClosedAndFurnished)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SceneFrame frame = take(smallView("room", 160, 120, seed));
    EXPECT_EQ(countValid(frame), frame.size()) << "room " << seed << " has a leak";
    EXPECT_GE(frame.planes.size(), 8u) << "room " << seed << " is nearly empty";
  }
}

TEST(Scenes, SameSeedSameBitsOtherSeedOthers)
{
  const SensorNoise noise = SensorNoise::kinect();
  const SceneFrame first = take(smallView("room"), noise, 7);
  const SceneFrame again = take(smallView("room"), noise, 7);
  const SceneFrame other_noise = take(smallView("room"), noise, 8);
  const SceneFrame other_room = take(smallView("room", 160, 120, 4), noise, 7);
  EXPECT_TRUE(sameBits(first.z, again.z));
  EXPECT_EQ(first.labels, again.labels);
  EXPECT_EQ(first.r, again.r);
  EXPECT_FALSE(sameBits(first.z, other_noise.z));
  EXPECT_FALSE(sameBits(first.z, other_room.z));
}

TEST(Random, IsTheSameEverywhereAndNormal)
{
  // std::mt19937_64's first output for its default seed is fixed: 14514284786278117030.
  EXPECT_EQ(Random(5489).uniform(),
            static_cast<double>(14514284786278117030u >> 11) * 0x1.0p-53);
  Random random(1);
  double sum = 0.0;
  double squares = 0.0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const double value = random.normal();
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.015);
  EXPECT_NEAR(squares / count, 1.0, 0.02);
}

TEST(Scenes, FixedScenesHaveTheStatedPlanes)
{
  EXPECT_EQ(take(smallView("single_plane")).planes.size(), 1u);
  EXPECT_EQ(take(smallView("corner")).planes.size(), 3u);
  EXPECT_EQ(countValid(take(smallView("corner"))), 160u * 120u);

  View view = step(0.2, 2.0);
  view.camera.resize(160, 120);
  const SceneFrame frame = take(view);
  ASSERT_EQ(frame.planes.size(), 2u);
  EXPECT_NEAR(frame.planes[0][3], 2.0, 1e-9);
  EXPECT_NEAR(frame.planes[1][3], 2.2, 1e-9);
  const std::vector<std::size_t> counts = frame.labelCounts();
  EXPECT_EQ(counts[0], 0u);
  EXPECT_EQ(counts[1], 160u * 120u / 2) << "the edge is not in the middle";

  const SceneFrame tilted = take([] {
    View turned = singlePlane(2.0, 0.5);
    turned.camera.resize(40, 30);
    return turned;
  }());
  EXPECT_NEAR(std::abs(tilted.planes.at(0)[2]), std::cos(0.5), 1e-9);
}

TEST(Scenes, StairsShowTwoPlanesPerStep)
{
  View view = stairs(3);
  const SceneFrame frame = take(view);
  // Floor, wall, three risers, three treads, perhaps a side.
  EXPECT_GE(frame.planes.size(), 8u);
  EXPECT_LE(frame.planes.size(), 9u);
}

TEST(Scenes, BallIsNoPlane)
{
  const SceneFrame frame = take(smallView("sphere_on_plane"));
  const std::vector<std::size_t> counts = frame.labelCounts();
  ASSERT_EQ(counts.size(), 2u);
  EXPECT_GT(counts[0], 500u) << "the ball does not show";
  EXPECT_GT(counts[1], 5000u);
  const std::size_t middle = 60 * 160 + 80;
  EXPECT_EQ(frame.labels[middle], 0u);
  EXPECT_TRUE(frame.valid(middle)) << "a ball is measured, but is no plane";
}

/// Standard deviation of the depth of a wall that faces the camera, metres.
double wallDeviation(double distance, const SensorNoise& noise)
{
  View view = singlePlane(distance);
  view.camera.resize(160, 120);
  const SceneFrame frame = take(view, noise, 11);
  double squares = 0.0;
  for (const float z : frame.z)
    squares += (z - distance) * (z - distance);
  return std::sqrt(squares / static_cast<double>(frame.size()));
}

TEST(KinectNoise, GrowsWithTheSquareOfTheDepth)
{
  for (const double z : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0}) {
    const double expected = 1.425e-3 * z * z;
    EXPECT_NEAR(wallDeviation(z, SensorNoise::kinect()), expected, 0.15 * expected)
        << "at " << z << " m";
  }
  const double loud = wallDeviation(2.0, SensorNoise::kinect(3.0));
  EXPECT_GT(loud, 2.2 * wallDeviation(2.0, SensorNoise::kinect()));
  EXPECT_LT(loud, 3.2 * wallDeviation(2.0, SensorNoise::kinect()));
}

TEST(KinectNoise, DepthComesInLevels)
{
  const SceneFrame frame = take(smallView("corner"), SensorNoise::kinect());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (!frame.valid(i))
      continue;
    const double level = 8.0 * 575.0 * 0.075 / static_cast<double>(frame.z[i]);
    ASSERT_NEAR(level, std::round(level), 1e-3) << "depth " << frame.z[i];
  }
}

TEST(KinectNoise, ShadowsLieLeftOfNearThingsOnly)
{
  SensorNoise quiet = SensorNoise::kinect(0.0);
  quiet.jitter = 0.0;
  View wall = singlePlane(2.0);
  EXPECT_EQ(countValid(take(wall, quiet)), 640u * 480u) << "a shadow of nothing";

  // A plate of 0.4 m at 1 m: its shadow on the wall at 2 m is one baseline wide, that
  // is 0.075 m (1/1 - 1/2) f = 20 columns of 525 pixels per metre at 1 m, on the left.
  wall.scene.beginObject();
  wall.scene.addPolygon(
      {{-0.2, 1, -0.2}, {0.2, 1, -0.2}, {0.2, 1, 0.2}, {-0.2, 1, 0.2}}, {1, 0, 0});
  const SceneFrame frame = take(wall, quiet);
  const std::size_t row = 240u * 640u;
  const std::size_t left = row + 320u - 105u; // first column of the plate
  const std::size_t right = row + 320u + 105u;
  int holes_left = 0;
  int holes_right = 0;
  for (std::size_t i = 1; i <= 40; ++i) {
    holes_left += frame.valid(left - i) ? 0 : 1;
    holes_right += frame.valid(right + i) ? 0 : 1;
  }
  EXPECT_NEAR(holes_left, 19.7, 1.5);
  EXPECT_EQ(holes_right, 0);

  quiet.shadows = false;
  EXPECT_EQ(countValid(take(wall, quiet)), 640u * 480u);
}

TEST(KinectNoise, RangeIsLimited)
{
  for (const double z : {0.4, 8.5}) {
    View view = singlePlane(z);
    view.camera.resize(20, 15);
    const SceneFrame frame = take(view, SensorNoise::kinect());
    EXPECT_EQ(countValid(frame), 0u) << "seen at " << z << " m";
    EXPECT_TRUE(frame.planes.empty());
  }
}

TEST(KinectNoise, JitterRoughensDepthEdgesOnly)
{
  SensorNoise noise = SensorNoise::kinect(0.0);
  noise.shadows = false;
  const View view = smallView("step");
  const SceneFrame exact = take(view);
  const SceneFrame rough = take(view, noise);
  int moved = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (exact.labels[i] == rough.labels[i])
      continue;
    ++moved;
    EXPECT_LE(std::abs(static_cast<int>(i % 160) - 80), 2) << "moved far from the edge";
  }
  EXPECT_GT(moved, 20);
}

TEST(GaussianNoise, HasTheStatedDeviationAlongTheRay)
{
  View view = singlePlane(2.0);
  const SceneFrame exact = take(view);
  const SceneFrame noisy = take(view, SensorNoise::gaussian(0.01), 2);
  double squares = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Eigen::Vector3f a(exact.x[i], exact.y[i], exact.z[i]);
    const Eigen::Vector3f b(noisy.x[i], noisy.y[i], noisy.z[i]);
    ASSERT_LT(a.cross(b).norm(), 1e-5f) << "the noise leaves the ray";
    squares += static_cast<double>((a - b).squaredNorm());
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(exact.size())), 0.01, 2e-4);
}

TEST(Lidar, LooksAlongTheStatedAngles)
{
  View view = cylinderRoom();
  view.camera.makeLidar(360, 16, Spherical{PI, -PI, 0.4, -0.4});
  const SceneFrame frame = take(view);
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 360; ++u) {
      const std::size_t i = static_cast<std::size_t>(v * 360 + u);
      if (!frame.valid(i))
        continue;
      const double x = static_cast<double>(frame.x[i]);
      const double y = static_cast<double>(frame.y[i]);
      const double z = static_cast<double>(frame.z[i]);
      ASSERT_NEAR(std::atan2(y, x), PI - (u + 0.5) * PI / 180.0, 1e-5);
      ASSERT_NEAR(std::atan2(z, std::hypot(x, y)), 0.4 - (v + 0.5) * 0.05, 1e-5);
    }
}

TEST(Render, TakesOddSizes)
{
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 5}, {1, 9}, {9, 1}}) {
    const View view = smallView("room", width, height);
    for (const SensorNoise& noise :
         {SensorNoise::none(), SensorNoise::gaussian(0.01), SensorNoise::kinect()})
      expectConsistent(take(view, noise));
  }
}

TEST(Render, RefusesWhatMakesNoSense)
{
  View view = corner();
  view.camera.makeLidar(32, 8);
  EXPECT_THROW(take(view, SensorNoise::kinect()), std::invalid_argument);
  view.camera.width = 0;
  EXPECT_THROW(take(view), std::invalid_argument);
  EXPECT_THROW(makeScene("attic"), std::invalid_argument);
}

} // namespace
