// SPDX-License-Identifier: BSD-3-Clause
//
// The fits of tiles against PCL's own plane fits.
#include "scenes/random.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <pcl/features/normal_3d.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <gtest/gtest.h>

#include <cmath>

namespace pcl_mrf_planes {
namespace {

struct Tile {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud{new pcl::PointCloud<pcl::PointXYZ>};
  ScatterMatrix sums;
};

/// A tilted wall at about two metres with 5 mm of noise.
Tile makeTile(std::uint64_t seed)
{
  scenes::Random random(seed);
  const double slope_x = random.uniform(-0.8, 0.8);
  const double slope_y = random.uniform(-0.8, 0.8);
  Tile tile;
  for (int i = 0; i < 400; ++i) {
    const double x = random.uniform(-0.3, 0.3);
    const double y = random.uniform(-0.3, 0.3);
    const double z = 2.0 + slope_x * x + slope_y * y + 0.005 * random.normal();
    tile.cloud->push_back(
        {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
    const pcl::PointXYZ& p = tile.cloud->back();
    tile.sums.add(p.x, p.y, p.z);
  }
  return tile;
}

TEST(PclFitsTest, GeometricIsComputePointNormal)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Tile tile = makeTile(seed);
    Eigen::Vector4f theirs;
    float curvature = 0.0f;
    ASSERT_TRUE(pcl::computePointNormal(*tile.cloud, theirs, curvature));
    if (theirs[3] < 0.0f)
      theirs = -theirs;
    const PlaneFitResult ours = fitPlane(tile.sums, PlaneFit::GEOMETRIC);
    ASSERT_TRUE(ours.valid);
    // PCL works in single precision about the first point.
    EXPECT_GT(ours.plane.normal.dot(theirs.head<3>().cast<double>()), 1.0 - 1e-7)
        << "another normal than PCL's, seed " << seed;
    EXPECT_NEAR(ours.plane.d, theirs[3], 1e-3) << "another offset than PCL's";
    const Eigen::Matrix3d covariance = tile.sums.covariance();
    EXPECT_NEAR(ours.rms * ours.rms / covariance.trace(), curvature, 1e-5)
        << "PCL's curvature is the smallest share of the spread, seed " << seed;
  }
}

TEST(PclFitsTest, BothFitsAreWithinNoiseOfAnOptimisedRansac)
{
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Tile tile = makeTile(seed);
    pcl::SACSegmentation<pcl::PointXYZ> sac;
    sac.setModelType(pcl::SACMODEL_PLANE);
    sac.setMethodType(pcl::SAC_RANSAC);
    sac.setOptimizeCoefficients(true);
    sac.setDistanceThreshold(0.03);
    sac.setInputCloud(tile.cloud);
    pcl::ModelCoefficients model;
    pcl::PointIndices inliers;
    sac.segment(inliers, model);
    ASSERT_EQ(model.values.size(), 4U);
    Eigen::Vector4d theirs(model.values[0], model.values[1], model.values[2],
                           model.values[3]);
    if (theirs[3] < 0.0)
      theirs = -theirs;
    for (const PlaneFit fit : {PlaneFit::GEOMETRIC, PlaneFit::ALGEBRAIC}) {
      const PlaneFitResult ours = fitPlane(tile.sums, fit);
      // 400 points with 5 mm: the plane is known to well below a millimetre.
      for (const pcl::PointXYZ& p : *tile.cloud) {
        const Eigen::Vector3d point(p.x, p.y, p.z);
        EXPECT_NEAR(ours.plane.distance(point), theirs.dot(point.homogeneous()), 1e-3)
            << "more than a millimetre from PCL's plane, seed " << seed;
      }
    }
  }
}

} // namespace
} // namespace pcl_mrf_planes
