// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/mrf_plane_segmentation.h>
#include <pcl_mrf_planes/sensor_pose.h>

#include "scenes/random.h"
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace {

using namespace pcl_mrf_planes;

const Eigen::Vector3d FAR_AWAY(1000.0, -1000.0, 500.0);

scenes::SceneFrame frameOf(const scenes::View& view)
{
  return scenes::render(view.scene, view.camera, scenes::SensorNoise::kinect(), 1);
}

/// Points of the frame, turned and moved, with their pixels.
std::vector<Sighting> sightingsOf(const scenes::SceneFrame& frame,
                                  const SensorPose& pose = {})
{
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < frame.size(); i += 97) {
    if (!frame.valid(i))
      continue;
    const Eigen::Vector3d point(frame.x[i], frame.y[i], frame.z[i]);
    const auto width = static_cast<std::size_t>(frame.width);
    const std::size_t row = i / width;
    const std::size_t column = i % width;
    sightings.push_back(
        {pose.rotation * point + pose.origin,
         Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row))});
  }
  return sightings;
}

SensorPose somePose()
{
  SensorPose pose;
  pose.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, -0.5).normalized())
                      .toRotationMatrix();
  pose.origin = FAR_AWAY;
  return pose;
}

TEST(PlausibleOrigin, HoldsForTheSensorAndFailsForAMovedCloud)
{
  const auto sightings = sightingsOf(frameOf(scenes::makeRoom(3)));
  EXPECT_TRUE(plausibleOrigin(sightings, Eigen::Vector3d::Zero()))
      << "a cloud seen from its sensor must not be doubted";
  EXPECT_FALSE(plausibleOrigin(sightings, FAR_AWAY))
      << "no sensor sees a room from a kilometre off";
  EXPECT_TRUE(plausibleOrigin({}, FAR_AWAY)) << "without points there is no doubt";
}

TEST(EstimatePinholePose, FindsTheCameraOfANoisyMovedCloud)
{
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const SensorPose truth = somePose();
    SensorPose found;
    ASSERT_TRUE(
        estimatePinholePose(sightingsOf(frameOf(scenes::makeRoom(seed)), truth), found))
        << "room " << seed << ": a pinhole camera explains its own cloud";
    EXPECT_LT((found.origin - truth.origin).norm(), 0.02)
        << "room " << seed << ": the origin is off";
    EXPECT_GT(found.rotation.col(2).dot(truth.rotation.col(2)), std::cos(0.01))
        << "room " << seed << ": the optical axis is off";
    EXPECT_NEAR(found.rotation.determinant(), 1.0, 1e-9) << "not a rotation";
  }
}

TEST(EstimatePinholePose, RefusesWhatDoesNotDetermineACamera)
{
  SensorPose pose;
  EXPECT_FALSE(estimatePinholePose({}, pose)) << "no points";
  scenes::View wall = scenes::singlePlane();
  const auto flat =
      scenes::render(wall.scene, wall.camera, scenes::SensorNoise::none(), 1);
  EXPECT_FALSE(estimatePinholePose(sightingsOf(flat), pose))
      << "one plane is explained by many cameras";

  scenes::View lidar = scenes::makeRoom(3);
  lidar.camera.makeLidar(512, 64);
  const auto scan =
      scenes::render(lidar.scene, lidar.camera, scenes::SensorNoise::none(), 1);
  EXPECT_FALSE(estimatePinholePose(sightingsOf(scan), pose))
      << "a rotating lidar is no pinhole camera";
}

TEST(EstimatePinholePose, RefusesSpotsAndParallelRays)
{
  SensorPose pose;
  scenes::Random random(4);
  std::vector<Sighting> one_point(100);
  std::vector<Sighting> one_pixel(100);
  std::vector<Sighting> parallel(100);
  for (std::size_t k = 0; k < 100; ++k) {
    const Eigen::Vector2d pixel(random.uniform(0, 640), random.uniform(0, 480));
    const Eigen::Vector3d point(pixel.x() / 100, pixel.y() / 100, random.uniform(1, 9));
    one_point[k] = {Eigen::Vector3d(1, 2, 3), pixel};
    one_pixel[k] = {point, Eigen::Vector2d(320, 240)};
    parallel[k] = {point, pixel};
  }
  EXPECT_FALSE(estimatePinholePose(one_point, pose));
  EXPECT_FALSE(estimatePinholePose(one_pixel, pose));
  EXPECT_FALSE(estimatePinholePose(parallel, pose)) << "a camera infinitely far away";
}

TEST(MovedCloud, SegmentsTheSameThoughItsOriginIsNotStated)
{
  const scenes::SceneFrame frame = frameOf(scenes::makeRoom(3));
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(
      new pcl::PointCloud<pcl::PointXYZ>(static_cast<std::uint32_t>(frame.width),
                                         static_cast<std::uint32_t>(frame.height)));
  for (std::size_t i = 0; i < frame.size(); ++i)
    (*cloud)[i] = pcl::PointXYZ(frame.x[i], frame.y[i], frame.z[i]);

  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setProfile(Profile::PAPER);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(planes, inliers);
  const std::vector<std::uint16_t> before = segmentation.getResult().labels;

  for (auto& point : *cloud)
    point.getVector3fMap() += FAR_AWAY.cast<float>();
  segmentation.segment(planes, inliers);
  const std::vector<std::uint16_t>& after = segmentation.getResult().labels;
  std::size_t different = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    different += before[i] != after[i];
  EXPECT_LT(static_cast<double>(different), 0.002 * static_cast<double>(before.size()))
      << "the place of the cloud in the world must not matter";
}

} // namespace
