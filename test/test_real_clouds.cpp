// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds of real sensors: the *.pcd files below the folder in the environment variable
// PCL_MRF_PLANES_DATA.
#include "reference/clouds.h"
#include "reference/paper_pipeline.h"

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pcl_mrf_planes {
namespace {

namespace fs = std::filesystem;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;

/// Organized clouds at the sensor's place, in the order of their names.
std::vector<fs::path> cloudFiles()
{
  std::vector<fs::path> files;
  const char* folder = std::getenv("PCL_MRF_PLANES_DATA");
  if (folder == nullptr || !fs::is_directory(folder))
    return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".pcd")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Cloud::Ptr load(const fs::path& file)
{
  Cloud::Ptr cloud(new Cloud);
  if (pcl::io::loadPCDFile(file.string(), *cloud) != 0 || !cloud->isOrganized())
    cloud->clear();
  return cloud;
}

bool atTheSensor(const Cloud& cloud)
{
  return cloud.sensor_origin_.head<3>().isZero(0.0f) &&
         cloud.sensor_orientation_.isApprox(Eigen::Quaternionf::Identity());
}

/// The points as the paper sees them.
OrganizedPoints toPoints(const Cloud& cloud)
{
  OrganizedPoints points;
  points.resize(static_cast<int>(cloud.width), static_cast<int>(cloud.height));
  for (std::size_t i = 0; i < cloud.size(); ++i)
    points.set(i, cloud[i].x, cloud[i].y, cloud[i].z);
  points.resolveDepthMeasure(DepthMeasure::AUTO);
  return points;
}

class RealCloudTest : public testing::Test {
protected:
  void SetUp() override
  {
    files_ = cloudFiles();
    if (files_.empty())
      GTEST_SKIP() << "PCL_MRF_PLANES_DATA names no folder with *.pcd files: the "
                      "clouds of real sensors are not tested";
  }
  std::vector<fs::path> files_;
};

bool isMeasured(const pcl::PointXYZ& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

// Profile PAPER labels every valid point of a cloud with planes; the default profile
// only valid points, and leaves out those on no plane.
TEST_F(RealCloudTest, EveryValidPointHasALabelAndPlanesAreSound)
{
  for (const Profile profile : {Profile::PAPER, Profile::DEFAULT}) {
    std::size_t organized = 0;
    std::size_t with_planes = 0;
    for (const fs::path& file : files_) {
      const Cloud::Ptr cloud = load(file);
      if (cloud->empty())
        continue;
      ++organized;
      Segmentation segmentation;
      segmentation.setProfile(profile);
      segmentation.setNumberOfThreads(0);
      segmentation.setInputCloud(cloud);
      reference::Output<pcl::PointXYZ> output;
      output.run(segmentation);
      ASSERT_EQ(output.labels.size(), cloud->size()) << file;
      with_planes += output.models.empty() ? 0U : 1U;
      for (std::size_t i = 0; i < cloud->size(); ++i) {
        const bool labelled = output.labels[i].label != 0;
        const bool valid = isMeasured((*cloud)[i]);
        ASSERT_LE(output.labels[i].label, output.models.size()) << file;
        if (profile == Profile::PAPER) {
          ASSERT_EQ(labelled, valid && !output.models.empty())
              << file << ": point " << i;
        }
        else {
          ASSERT_TRUE(valid || !labelled) << file << ": point " << i;
        }
      }
      for (const auto& model : output.models) {
        const Eigen::Vector3f normal(model.values[0], model.values[1], model.values[2]);
        EXPECT_NEAR(normal.norm(), 1.0f, 1e-5f) << file;
        if (atTheSensor(*cloud)) {
          EXPECT_GE(model.values[3], 0.0f) << file;
        }
      }
    }
    EXPECT_GT(organized, 0U) << "none of the files is an organized cloud";
    EXPECT_GT(2 * with_planes, organized) << "most real scenes have planes";
  }
}

TEST_F(RealCloudTest, LabelsAreThoseOfTheReferencePipeline)
{
  std::map<fs::path, fs::path> first_of_folder;
  for (const fs::path& file : files_)
    first_of_folder.emplace(file.parent_path(), file);
  const Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  for (const auto& entry : first_of_folder) {
    const Cloud::Ptr cloud = load(entry.second);
    if (cloud->empty() || !atTheSensor(*cloud))
      continue;
    const OrganizedPoints points = toPoints(*cloud);
    const PlaneSegmentation result = segmentPlanes(points, parameters);
    const auto expected =
        reference::segmentAsPaper<reference::WholeUnitEnergy>(points, parameters);
    ASSERT_EQ(result.clusters.planes.size(), expected.planes.size()) << entry.second;
    if (expected.planes.empty())
      continue;
    std::size_t different = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points.valid[i] != 0)
        different +=
            result.regions[result.labels[i] - 1U].label != expected.labels[i] ? 1U : 0U;
    EXPECT_EQ(different, 0U) << entry.second << ": profile PAPER is not the paper, of "
                             << points.size() << " points with "
                             << expected.planes.size() << " planes";
  }
}

} // namespace
} // namespace pcl_mrf_planes
