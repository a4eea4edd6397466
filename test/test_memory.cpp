// SPDX-License-Identifier: BSD-3-Clause
//
// What a segmentation asks for, nothing once it has seen its clouds, and what it leaves behind:
// nothing that grows. PCL_MRF_PLANES_LONG=1 runs ten thousand frames and the largest cloud (3 GB
// of memory) as well.
#include "allocation_calls.h"
#include "frame_memory.h"
#include "reference/inputs.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <gtest/gtest.h>

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <vector>

namespace pcl_mrf_planes {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;

bool longRun()
{
  return std::getenv("PCL_MRF_PLANES_LONG") != nullptr;
}

/// Bytes that are allocated now; 0 where another allocator is in place (sanitizers).
std::size_t allocated()
{
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// A floor and a wall, seen as by a pinhole camera.
Cloud::Ptr corner(int width, int height)
{
  Cloud::Ptr cloud(
      new Cloud(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)));
  const float scale = 1.0f / static_cast<float>(width);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const float x = scale * static_cast<float>(u - width / 2);
      const float y = scale * static_cast<float>(v - height / 2);
      const float z = y > 0.0f ? std::min(2.0f, 0.3f / y) : 2.0f;
      cloud->at(u, v) = {x * z, y * z, z};
    }
  return cloud;
}

Cloud::Ptr toCloud(const scenes::SceneFrame& frame)
{
  Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(frame.width),
                             static_cast<std::uint32_t>(frame.height)));
  for (std::size_t i = 0; i < frame.size(); ++i)
    (*cloud)[i] = {frame.x[i], frame.y[i], frame.z[i]};
  return cloud;
}

Cloud::Ptr room(int width, int height, std::uint64_t seed)
{
  return toCloud(reference::takePicture("room", width, height, seed,
                                        scenes::SensorNoise::kinect()));
}

/// Seen all around: its depth is the distance, which the fields measure themselves.
Cloud::Ptr lidarRoom()
{
  scenes::View view = scenes::makeScene("room", 3);
  view.camera.makeLidar(512, 64);
  return toCloud(
      scenes::render(view.scene, view.camera, scenes::SensorNoise::gaussian(0.01), 3));
}

/// Cameras and a lidar, several sizes, many planes and few.
std::vector<Cloud::Ptr> differentClouds()
{
  return {room(320, 240, 1), corner(320, 240),  lidarRoom(),
          room(320, 240, 2), room(200, 170, 5), corner(33, 17)};
}

/// An object and all that it is asked to fill, for one cloud after the other.
class Sequence {
public:
  Sequence(Profile profile, unsigned int threads)
  {
    segmentation_.setProfile(profile);
    segmentation_.setNumberOfThreads(threads);
  }

  /// \return how often memory was asked for
  std::size_t segment(const Cloud::Ptr& cloud)
  {
    const std::size_t before = test::allocationCalls();
    segmentation_.setInputCloud(cloud);
    segmentation_.segment(planes_, inliers_);
    segmentation_.segment(planes_, inliers_, centroids_, covariances_, labels_,
                          label_indices_);
    return test::allocationCalls() - before;
  }

  std::size_t segment(const std::vector<Cloud::Ptr>& clouds)
  {
    std::size_t calls = 0;
    for (const Cloud::Ptr& cloud : clouds)
      calls += segment(cloud);
    return calls;
  }

  std::size_t planes() const { return planes_.size(); }

private:
  Segmentation segmentation_;
  std::vector<pcl::ModelCoefficients> planes_;
  std::vector<pcl::PointIndices> inliers_, label_indices_;
  Segmentation::Centroids centroids_;
  Segmentation::Covariances covariances_;
  pcl::PointCloud<pcl::Label> labels_;
};

constexpr Profile PROFILES[] = {Profile::DEFAULT, Profile::FAST, Profile::PAPER};

class Allocation : public testing::TestWithParam<Profile> {
protected:
  void SetUp() override
  {
    if (!FrameMemory::keeps())
      GTEST_SKIP() << "a sanitizer is to see every vector";
  }
};

INSTANTIATE_TEST_SUITE_P(Profiles, Allocation, testing::ValuesIn(PROFILES));

TEST_P(Allocation, ARepeatedFrameNeedsNone)
{
  for (const Cloud::Ptr& cloud : differentClouds()) {
    Sequence sequence(GetParam(), 1);
    EXPECT_GT(sequence.segment(cloud), 0U) << "they are counted";
    sequence.segment(cloud);
    for (int frame = 0; frame < 3; ++frame)
      EXPECT_EQ(sequence.segment(cloud), 0U) << cloud->width << " columns";
  }
}

TEST_P(Allocation, FramesThatAlternateNeedNone)
{
  const std::vector<Cloud::Ptr> clouds = differentClouds();
  Sequence sequence(GetParam(), 1);
  for (int round = 0; round < 3; ++round)
    sequence.segment(clouds);
  EXPECT_EQ(sequence.segment(clouds), 0U);
  sequence.segment(clouds[0]);
  EXPECT_GE(sequence.planes(), 3U);
}

TEST_P(Allocation, TwoThreadsNeedThatOfTheirTeam)
{
  const Cloud::Ptr cloud = room(320, 240, 1);
  Sequence sequence(GetParam(), 2);
  std::size_t least = sequence.segment(cloud);
  for (int frame = 0; frame < 20; ++frame)
    least = std::min(least, sequence.segment(cloud));
  constexpr std::size_t OF_A_TEAM = 2; // itself and the board of its work
  EXPECT_LE(least, 2 * OF_A_TEAM) << "two clouds are segmented";
}

TEST(Memory, TheCoreNeedsNoneEither)
{
  if (!FrameMemory::keeps())
    GTEST_SKIP() << "a sanitizer is to see every vector";
  OrganizedPoints points = reference::toPoints(
      reference::takePicture("room", 320, 240, 1, scenes::SensorNoise::kinect()));
  points.resolveDepthMeasure(DepthMeasure::AUTO);
  for (const Profile profile : PROFILES) {
    Parameters parameters = Parameters::fromProfile(profile);
    parameters.number_of_threads = 1;
    PlaneSegmenter segmenter;
    PlaneSegmentation result;
    for (int frame = 0; frame < 3; ++frame)
      segmenter.segment(points, parameters, result);
    const std::size_t before = test::allocationCalls();
    segmenter.segment(points, parameters, result);
    EXPECT_EQ(test::allocationCalls() - before, 0U)
        << "profile " << static_cast<int>(profile);
  }
}

TEST(Memory, DoesNotGrowWithTheFrames)
{
  if (allocated() == 0)
    GTEST_SKIP() << "this allocator does not count";
  std::vector<Cloud::Ptr> clouds;
  for (const auto& [width, height] :
       {std::array{64, 48}, {48, 64}, {33, 17}, {96, 8}, {80, 60}, {1, 40}})
    clouds.push_back(corner(width, height));

  for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER}) {
    Segmentation segmentation;
    segmentation.setProfile(profile);
    std::vector<pcl::ModelCoefficients> planes;
    std::vector<pcl::PointIndices> inliers;
    std::size_t found = 0;
    const auto runAll = [&](std::size_t rounds) {
      for (std::size_t round = 0; round < rounds; ++round)
        for (const Cloud::Ptr& cloud : clouds) {
          segmentation.setInputCloud(cloud);
          segmentation.segment(planes, inliers);
          found += planes.size();
        }
    };
    runAll(5);
    const std::size_t before = allocated();
    runAll((longRun() ? 10002U : 300U) / clouds.size());
    // Seven bytes a frame would show in the long run, 220 in the short one.
    EXPECT_LT(allocated(), before + 65536U) << "profile " << static_cast<int>(profile);
    EXPECT_GT(found, 0U);
  }
}

TEST(Memory, SizesWhoseProductOverflowsAreRefused)
{
  // The products are 0, 1 and 4 in 32 bits.
  for (const auto& [width, height, count] :
       {std::array{65536U, 65536U, 0U}, {641U, 6700417U, 1U}, {2147483650U, 2U, 4U}}) {
    Cloud::Ptr cloud(new Cloud);
    cloud->points.resize(count);
    cloud->width = width;
    cloud->height = height;
    Segmentation segmentation;
    segmentation.setInputCloud(cloud);
    std::vector<pcl::ModelCoefficients> planes(1);
    std::vector<pcl::PointIndices> inliers(1);
    testing::internal::CaptureStderr();
    EXPECT_NO_THROW(segmentation.segment(planes, inliers));
    EXPECT_FALSE(testing::internal::GetCapturedStderr().empty());
    EXPECT_TRUE(planes.empty());
    EXPECT_TRUE(inliers.empty());
  }
}

TEST(Memory, TheLargestCloudIsSegmented)
{
  if (!longRun())
    GTEST_SKIP() << "set PCL_MRF_PLANES_LONG=1";
  Segmentation segmentation;
  segmentation.setInputCloud(corner(8192, 8192));
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(planes, inliers);
  EXPECT_EQ(planes.size(), 2U);
  std::size_t points = 0;
  for (const pcl::PointIndices& plane : inliers)
    points += plane.indices.size();
  EXPECT_GT(points, std::size_t{8192} * 8192 / 10 * 9);
}

} // namespace
} // namespace pcl_mrf_planes
