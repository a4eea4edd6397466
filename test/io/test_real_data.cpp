// SPDX-License-Identifier: BSD-3-Clause
// Real depth images beside the clouds that others made of them.
#include "io_files.h"

#include <cmath>
#include <cstdlib>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;

TEST(RealDepthImages, GiveTheCloudsBesideThem)
{
  const char* data = std::getenv("PCL_MRF_PLANES_DATA");
  if (data == nullptr)
    GTEST_SKIP() << "PCL_MRF_PLANES_DATA names no folder";
  std::size_t compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(data)) {
    const std::string file = entry.path().string();
    const std::string end = ".depth.png";
    if (file.size() < end.size() ||
        file.compare(file.size() - end.size(), end.size(), end) != 0)
      continue;
    SCOPED_TRACE(file);
    const std::string cloud = file.substr(0, file.size() - end.size()) + ".pcd";
    const io::Frame depth = io::listFrames({file}, {}).frames.at(0).read();
    const io::CloudFile expected = io::readOrganizedCloud(cloud);
    ASSERT_EQ(depth.file.cloud.width, expected.cloud.width);
    std::size_t apart = 0, valid = 0;
    for (std::size_t i = 0; i < expected.cloud.width * expected.cloud.height; ++i) {
      const Eigen::Vector3f a = pointOf(depth.file, i), b = pointOf(expected, i);
      ASSERT_EQ(std::isnan(a.z()), std::isnan(b.z())) << i;
      valid += std::isnan(a.z()) ? 0 : 1;
      apart += (a - b).norm() > 1e-3f + 1e-3f * b.norm() ? 1 : 0;
    }
    EXPECT_EQ(apart, 0u) << "of " << valid;
    ++compared;
  }
  EXPECT_GT(compared, 0u);
}

} // namespace pcl_mrf_planes::test
