// SPDX-License-Identifier: BSD-3-Clause
//
// What a segmentation leaves behind: nothing that grows. PCL_MRF_PLANES_LONG=1 runs ten
// thousand frames and the largest cloud (3 GB of memory) as well.
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
