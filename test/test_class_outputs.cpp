// SPDX-License-Identifier: BSD-3-Clause
//
// pcl::MRFPlaneSegmentation: what comes out, in all the shapes of segment().
#include "reference/clouds.h"
#include "reference/inputs.h"

#include <pcl/common/transforms.h>
#include <pcl/features/integral_image_normal.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace pcl_mrf_planes {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;
using Output = reference::Output<pcl::PointXYZ>;

scenes::SceneFrame room(int width = 160, int height = 120)
{
  return reference::takePicture("room", width, height, 4,
                                scenes::SensorNoise::kinect());
}

void prepare(Segmentation& segmentation, const Cloud::ConstPtr& cloud)
{
  segmentation.setProfile(Profile::PAPER);
  segmentation.setTileSize(10, 10);
  segmentation.setInputCloud(cloud);
}

TEST(ClassOutputTest, AllShapesTellTheSame)
{
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(room());
  cloud->header.frame_id = "camera";
  Segmentation segmentation;
  prepare(segmentation, cloud);
  Output output;
  output.run(segmentation);
  ASSERT_GE(output.models.size(), 3U);

  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(models, inliers);
  ASSERT_EQ(models.size(), output.models.size());
  ASSERT_EQ(inliers.size(), models.size());
  ASSERT_EQ(output.centroids.size(), models.size());
  ASSERT_EQ(output.covariances.size(), models.size());
  ASSERT_EQ(output.label_indices.size(), models.size() + 1);
  EXPECT_TRUE(output.label_indices[0].indices.empty()) << "no plane is no region";
  ASSERT_EQ(output.labels.width, cloud->width) << "labels have the shape of the cloud";
  ASSERT_EQ(output.labels.height, cloud->height);
  std::size_t labelled = 0;
  for (std::size_t k = 0; k < models.size(); ++k) {
    EXPECT_EQ(models[k].values, output.models[k].values) << "plane " << k;
    EXPECT_EQ(models[k].header.frame_id, "camera") << "the header must be passed on";
    EXPECT_EQ(inliers[k].indices, output.inliers[k].indices) << "plane " << k;
    EXPECT_EQ(output.label_indices[k + 1].indices, inliers[k].indices) << "plane " << k;
    for (const auto i : inliers[k].indices)
      EXPECT_EQ(output.labels[static_cast<std::size_t>(i)].label, k + 1)
          << "point " << i;
    labelled += inliers[k].indices.size();
    const Eigen::Vector3f normal(models[k].values[0], models[k].values[1],
                                 models[k].values[2]);
    EXPECT_NEAR(normal.norm(), 1.0f, 1e-5f) << "coefficients are of unit length";
    EXPECT_GE(models[k].values[3], 0.0f) << "the normal points to the sensor";
  }
  std::size_t measured = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const bool valid = std::isfinite((*cloud)[i].z);
    measured += valid ? 1U : 0U;
    EXPECT_EQ(output.labels[i].label != 0, valid) << "every valid point gets a plane";
  }
  EXPECT_EQ(labelled, measured);

  const auto& report = segmentation.getReport();
  EXPECT_EQ(report.points, cloud->size());
  EXPECT_EQ(report.valid_points, measured);
  EXPECT_EQ(report.planes, models.size());
  EXPECT_EQ(report.tiles_tried, 16U * 12U);
  EXPECT_GE(report.tiles_kept, report.planes_after_merging);
  EXPECT_GE(report.planes_after_merging, report.planes);
  EXPECT_EQ(report.iterations, 5);
  EXPECT_DOUBLE_EQ(report.labelled_share, 1.0);
  EXPECT_GT(report.totalMs(), 0.0);
}

TEST(ClassOutputTest, TheDefaultProfileLeavesOutWhatIsOnNoPlane)
{
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(room(320, 240));
  Segmentation segmentation;
  segmentation.setInputCloud(cloud);
  EXPECT_EQ(segmentation.getParameters().method, Method::ADAPTIVE);
  Output output;
  output.run(segmentation);
  ASSERT_GE(output.models.size(), 3U);
  ASSERT_EQ(output.inliers.size(), output.models.size());
  ASSERT_EQ(output.label_indices.size(), output.models.size() + 1);
  EXPECT_TRUE(output.label_indices[0].indices.empty()) << "no plane is no region";
  std::size_t in_planes = 0;
  for (std::size_t k = 0; k < output.models.size(); ++k) {
    EXPECT_EQ(output.label_indices[k + 1].indices, output.inliers[k].indices);
    for (const auto i : output.inliers[k].indices)
      ASSERT_EQ(output.labels[static_cast<std::size_t>(i)].label, k + 1);
    in_planes += output.inliers[k].indices.size();
  }
  std::size_t labelled = 0;
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const bool valid = std::isfinite((*cloud)[i].z);
    labelled += output.labels[i].label != 0 ? 1U : 0U;
    left_out += valid && output.labels[i].label == 0 ? 1U : 0U;
    EXPECT_TRUE(valid || output.labels[i].label == 0) << "invalid point " << i;
  }
  EXPECT_EQ(labelled, in_planes);
  EXPECT_GT(left_out, 0U) << "a furnished room has points on no plane";
  const auto& report = segmentation.getReport();
  EXPECT_EQ(report.planes, output.models.size());
  EXPECT_EQ(report.valid_points, labelled + left_out);
  EXPECT_LT(report.labelled_share, 1.0);

  Segmentation paper;
  paper.setProfile(Profile::PAPER);
  EXPECT_EQ(paper.getParameters().method, Method::PAPER);
}

TEST(ClassOutputTest, RegionsHaveTheStatisticsAndTheBorder)
{
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(room());
  Segmentation segmentation;
  prepare(segmentation, cloud);
  Output output;
  output.run(segmentation);
  Segmentation::PlanarRegions regions;
  std::vector<pcl::PointIndices> boundaries;
  Segmentation::PointCloudLPtr labels;
  segmentation.segmentAndRefine(regions, output.models, output.inliers, labels,
                                output.label_indices, boundaries);
  ASSERT_TRUE(labels);
  ASSERT_EQ(regions.size(), output.models.size());
  ASSERT_EQ(boundaries.size(), regions.size());
  double last_area = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < regions.size(); ++k) {
    EXPECT_EQ(regions[k].getCount(), output.inliers[k].indices.size());
    EXPECT_TRUE(regions[k].getCentroid().isApprox(output.centroids[k].head<3>()));
    EXPECT_TRUE(regions[k].getCovariance().isApprox(output.covariances[k]));
    for (int c = 0; c < 4; ++c)
      EXPECT_EQ(regions[k].getCoefficients()[c],
                output.models[k].values[static_cast<std::size_t>(c)]);
    const auto contour = regions[k].getContour();
    ASSERT_EQ(contour.size(), boundaries[k].indices.size());
    for (std::size_t j = 0; j < contour.size(); ++j) {
      const int i = boundaries[k].indices[j];
      const auto at = static_cast<std::size_t>(i);
      EXPECT_EQ(contour[j].x, (*cloud)[at].x) << "contours are points of the cloud";
      ASSERT_EQ((*labels)[at].label, k + 1) << "the contour leaves the region";
      const int x = i % 160;
      const int y = i / 160;
      const bool border =
          x == 0 || y == 0 || x == 159 || y == 119 ||
          (*labels)[at - 1].label != k + 1 || (*labels)[at + 1].label != k + 1 ||
          (*labels)[at - 160].label != k + 1 || (*labels)[at + 160].label != k + 1;
      EXPECT_TRUE(border) << "point " << i
                          << " is inside of the region, not on its border";
    }
    const double area = segmentation.getResult().regions[k].area;
    EXPECT_LE(area, last_area) << "largest area first";
    last_area = area;
  }
  segmentation.setProjectPoints(true);
  segmentation.segment(regions);
  for (const auto& region : regions)
    for (const auto& p : region.getContour())
      EXPECT_NEAR(region.getCoefficients().dot(Eigen::Vector4f(p.x, p.y, p.z, 1)), 0.0f,
                  1e-4f)
          << "projected contours lie on the plane";
}

TEST(ClassOutputTest, SettersAndGettersAgreeWithTheStruct)
{
  Segmentation s;
  s.setTileSize(7, 9);
  s.setPlaneFit(PlaneFit::GEOMETRIC);
  s.setNoiseMultiplier(2.5);
  s.setMinValidShare(0.25);
  s.setDepthMeasure(DepthMeasure::RANGE);
  s.setBeta(0.3);
  s.setMergeThreshold(0.2);
  s.setLambda(3.0);
  s.setTau(0.7);
  s.setSmoothness(Smoothness::POTTS);
  s.setGamma(0.9);
  s.setIterations(11);
  s.setConvergenceTolerance(0.5);
  s.setComputeEnergy(true);
  s.setMinInliers(33);
  s.setNumberOfThreads(2);
  const Parameters& p = s.getParameters();
  EXPECT_TRUE(p.tile_width == 7 && s.getTileWidth() == 7);
  EXPECT_TRUE(p.tile_height == 9 && s.getTileHeight() == 9);
  EXPECT_TRUE(p.fit == PlaneFit::GEOMETRIC && s.getPlaneFit() == p.fit);
  EXPECT_TRUE(p.noise_multiplier == 2.5 && s.getNoiseMultiplier() == 2.5);
  EXPECT_TRUE(p.min_valid_share == 0.25 && s.getMinValidShare() == 0.25);
  EXPECT_TRUE(p.depth_measure == DepthMeasure::RANGE &&
              s.getDepthMeasure() == p.depth_measure);
  EXPECT_TRUE(p.beta == 0.3 && s.getBeta() == 0.3);
  EXPECT_TRUE(p.merge_threshold == 0.2 && s.getMergeThreshold() == 0.2);
  EXPECT_TRUE(p.lambda == 3.0 && s.getLambda() == 3.0);
  EXPECT_TRUE(p.tau == 0.7 && s.getTau() == 0.7);
  EXPECT_TRUE(p.smoothness == Smoothness::POTTS && s.getSmoothness() == p.smoothness);
  EXPECT_TRUE(p.gamma == 0.9 && s.getGamma() == 0.9);
  EXPECT_TRUE(p.iterations == 11 && s.getIterations() == 11);
  EXPECT_TRUE(p.convergence_tolerance == 0.5 && s.getConvergenceTolerance() == 0.5);
  EXPECT_TRUE(p.compute_energy && s.getComputeEnergy());
  EXPECT_TRUE(p.min_inliers == 33 && s.getMinInliers() == 33);
  EXPECT_TRUE(p.number_of_threads == 2 && s.getNumberOfThreads() == 2);
  s.setProfile(Profile::PAPER);
  EXPECT_EQ(s.getTileWidth(), 40) << "a profile sets all the values";
  EXPECT_EQ(s.getGamma(), Parameters().gamma) << "a profile sets all the values";
}

TEST(ClassOutputTest, MovingTheCloudMovesThePlanes)
{
  const auto frame = room(320, 240);
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(frame);
  Eigen::Affine3f motion = Eigen::Affine3f::Identity();
  motion.translate(Eigen::Vector3f(1000.0f, -700.0f, 250.0f));
  motion.rotate(Eigen::AngleAxisf(0.8f, Eigen::Vector3f(1, 2, -1).normalized()));
  const Cloud::Ptr moved(new Cloud);
  pcl::transformPointCloud(*cloud, *moved, motion);
  moved->sensor_origin_ << motion.translation(), 1.0f;
  moved->sensor_orientation_ = Eigen::Quaternionf(motion.rotation());

  Output at_home;
  Output away;
  Segmentation segmentation;
  prepare(segmentation, cloud);
  at_home.run(segmentation);
  prepare(segmentation, moved);
  away.run(segmentation);
  ASSERT_EQ(away.models.size(), at_home.models.size());
  ASSERT_GE(away.models.size(), 3U);
  // Planes of nearly the same area may change places.
  std::vector<std::uint32_t> partner = {0};
  for (std::size_t k = 0; k < at_home.models.size(); ++k) {
    const auto& here = at_home.models[k].values;
    const Eigen::Vector3f normal =
        motion.rotation() * Eigen::Vector3f(here[0], here[1], here[2]);
    const Eigen::Vector4f centroid = motion * at_home.centroids[k];
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < away.models.size(); ++j) {
      const auto& there = away.models[j].values;
      const double turned =
          (normal - Eigen::Vector3f(there[0], there[1], there[2])).norm();
      const double moved_by = (centroid - away.centroids[j]).head<3>().norm();
      if (turned + moved_by < least) {
        least = turned + moved_by;
        best = j;
      }
    }
    EXPECT_LT(least, 0.02) << "plane " << k << " did not move along with the cloud";
    partner.push_back(static_cast<std::uint32_t>(best + 1));
    // Offsets where the points are; d itself is rounded at a kilometre.
    const auto& there = away.models[best].values;
    const double offset = there[0] * away.centroids[best][0] +
                          there[1] * away.centroids[best][1] +
                          there[2] * away.centroids[best][2] + there[3];
    const double expected = here[0] * at_home.centroids[k][0] +
                            here[1] * at_home.centroids[k][1] +
                            here[2] * at_home.centroids[k][2] + here[3];
    EXPECT_NEAR(offset, expected, 2e-3) << "plane " << k << " has another offset";
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    different += partner[at_home.labels[i].label] != away.labels[i].label ? 1U : 0U;
  // Coordinates of a kilometre have steps of 0.06 mm.
  EXPECT_LE(different, cloud->size() / 500) << "the place in the world has a say";
}

TEST(ClassOutputTest, ColourHasNoInfluence)
{
  const auto frame = room();
  const auto grey = reference::toCloud<pcl::PointXYZRGB>(frame);
  const auto colourful = reference::toCloud<pcl::PointXYZRGB>(frame);
  scenes::Random random(1);
  for (auto& p : *colourful)
    p.rgba = static_cast<std::uint32_t>(random.integer(0, 0xFFFFFF));
  std::vector<std::uint32_t> labels[2];
  for (int i = 0; i < 2; ++i) {
    pcl::MRFPlaneSegmentation<pcl::PointXYZRGB> segmentation;
    segmentation.setProfile(Profile::PAPER);
    segmentation.setTileSize(10, 10);
    segmentation.setInputCloud(i == 0 ? grey : colourful);
    reference::Output<pcl::PointXYZRGB> output;
    output.run(segmentation);
    labels[i] = output.labelValues();
  }
  EXPECT_EQ(labels[0], labels[1]) << "only geometry may be used";
}

TEST(ClassOutputTest, RunsAndThreadsGiveTheSameBits)
{
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(room(231, 177));
  Segmentation segmentation;
  prepare(segmentation, cloud);
  Output expected;
  expected.run(segmentation);
  for (const unsigned int threads : {1U, 2U, 3U, 0U}) {
    segmentation.setNumberOfThreads(threads);
    Output output;
    output.run(segmentation);
    EXPECT_EQ(output.labelValues(), expected.labelValues()) << threads << " threads";
    ASSERT_EQ(output.models.size(), expected.models.size());
    for (std::size_t k = 0; k < output.models.size(); ++k) {
      EXPECT_EQ(output.models[k].values, expected.models[k].values) << threads;
      EXPECT_EQ(output.centroids[k], expected.centroids[k]) << threads;
      EXPECT_EQ(output.covariances[k], expected.covariances[k]) << threads;
    }
  }
}

TEST(ClassOutputTest, OutputsThatAreGivenAgainAreWrittenOver)
{
  const Cloud::Ptr large = reference::toCloud<pcl::PointXYZ>(room(231, 177));
  const Cloud::Ptr small = reference::toCloud<pcl::PointXYZ>(
      reference::takePicture("corner", 120, 90, 4, scenes::SensorNoise::kinect()));
  large->header.frame_id = "large";
  small->header.frame_id = "small";
  Segmentation used;
  std::vector<pcl::ModelCoefficients> models(1);
  std::vector<pcl::PointIndices> inliers(50);
  for (const Cloud::Ptr& cloud : {large, small, large}) {
    used.setInputCloud(cloud);
    used.segment(models, inliers);
    Segmentation unused;
    unused.setInputCloud(cloud);
    std::vector<pcl::ModelCoefficients> expected_models;
    std::vector<pcl::PointIndices> expected_inliers;
    unused.segment(expected_models, expected_inliers);
    ASSERT_EQ(models.size(), expected_models.size());
    ASSERT_EQ(inliers.size(), models.size());
    for (std::size_t k = 0; k < models.size(); ++k) {
      EXPECT_EQ(models[k].values, expected_models[k].values);
      EXPECT_EQ(models[k].header.frame_id, cloud->header.frame_id);
      EXPECT_EQ(inliers[k].indices, expected_inliers[k].indices);
      EXPECT_EQ(inliers[k].header.frame_id, cloud->header.frame_id);
    }
  }
  used.setInputCloud(Cloud::Ptr(new Cloud));
  used.segment(models, inliers);
  EXPECT_TRUE(models.empty()) << "an empty cloud has no planes";
  EXPECT_TRUE(inliers.empty());
  EXPECT_TRUE(used.getResult().regions.empty());
}

/// The calls of a program that used pcl::OrganizedMultiPlaneSegmentation.
template <typename SegmentationT>
std::size_t programOfAUser(SegmentationT& segmentation, const Cloud::ConstPtr& cloud)
{
  segmentation.setInputCloud(cloud);
  std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
              Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>
      regions;
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  pcl::PointCloud<pcl::Label>::Ptr labels(new pcl::PointCloud<pcl::Label>);
  std::vector<pcl::PointIndices> label_indices;
  std::vector<pcl::PointIndices> boundary_indices;
  segmentation.segmentAndRefine(regions, models, inliers, labels, label_indices,
                                boundary_indices);
  std::size_t points = 0;
  for (std::size_t k = 0; k < regions.size(); ++k)
    points += inliers[k].indices.size();
  EXPECT_EQ(labels->size(), cloud->size());
  EXPECT_EQ(models.size(), inliers.size());
  EXPECT_EQ(boundary_indices.size(), regions.size());
  segmentation.segment(models, inliers);
  segmentation.segment(regions);
  segmentation.segmentAndRefine(regions);
  std::vector<Eigen::Vector4f, Eigen::aligned_allocator<Eigen::Vector4f>> centroids;
  std::vector<Eigen::Matrix3f, Eigen::aligned_allocator<Eigen::Matrix3f>> covariances;
  // PCL's class wants these empty; ours does not mind.
  pcl::PointCloud<pcl::Label> plain_labels;
  std::vector<pcl::PointIndices> plain_indices;
  segmentation.segment(models, inliers, centroids, covariances, plain_labels,
                       plain_indices);
  EXPECT_EQ(centroids.size(), covariances.size());
  return points;
}

TEST(SwapTest, TheSameProgramRunsWithBothClasses)
{
  const auto frame =
      reference::takePicture("corner", 160, 120, 1, scenes::SensorNoise::none());
  const Cloud::Ptr cloud = reference::toCloud<pcl::PointXYZ>(frame);
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setNormalSmoothingSize(8.0f);
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);

  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> theirs;
  theirs.setInputNormals(normals);
  theirs.setMinInliers(500);
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> ours;
  ours.setProfile(Profile::PAPER);
  ours.setTileSize(10, 10);
  ours.setMinInliers(500);
  const std::size_t by_theirs = programOfAUser(theirs, cloud);
  const std::size_t by_ours = programOfAUser(ours, cloud);
  EXPECT_GE(static_cast<double>(by_ours), 0.98 * static_cast<double>(by_theirs))
      << "on clean data ours must cover what PCL's class covers";
}

} // namespace
} // namespace pcl_mrf_planes
