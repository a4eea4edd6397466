// SPDX-License-Identifier: BSD-3-Clause
//
// pcl::MRFPlaneSegmentation: what follows from a result, beside PCL's own filters.
#include "reference/clouds.h"
#include "reference/inputs.h"

#include "polygon_simplification.h"

#include <pcl/ModelCoefficients.h>
#include <pcl/common/transforms.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/project_inliers.h>
#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace pcl_mrf_planes {
namespace {

using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;
using Segmentation = pcl::MRFPlaneSegmentation<Point>;

class AnalysisTest : public testing::Test {
protected:
  AnalysisTest()
  : cloud_(reference::toCloud<Point>(
        reference::takePicture("room", 320, 240, 0, scenes::SensorNoise::kinect())))
  {
    segmentation_.setInputCloud(cloud_);
  }

  void segment() { segmentation_.segment(models_, inliers_); }

  Eigen::Vector4d model(std::size_t k) const
  {
    return Eigen::Vector4f(models_[k].values.data()).cast<double>();
  }

  Cloud::Ptr cloud_;
  Segmentation segmentation_;
  std::vector<pcl::ModelCoefficients> models_;
  std::vector<pcl::PointIndices> inliers_;
};

TEST_F(AnalysisTest, RegionsPolygonsAndHullsLieOnTheirPlanes)
{
  segment();
  ASSERT_GE(models_.size(), 3U);
  std::vector<RegionOutline> outlines;
  segmentation_.computeOutlines(outlines);
  Segmentation::PlanarPolygons polygons;
  std::vector<std::size_t> region_of_polygon;
  segmentation_.computePolygons(polygons, region_of_polygon);
  Segmentation::PlanarPolygons hulls;
  segmentation_.computeHulls(hulls);
  ASSERT_EQ(outlines.size(), models_.size());
  ASSERT_EQ(hulls.size(), models_.size());
  ASSERT_EQ(polygons.size(), region_of_polygon.size());
  ASSERT_GE(polygons.size(), models_.size());
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    const Eigen::Vector4d plane = model(region_of_polygon[p]);
    EXPECT_LT((polygons[p].getCoefficients().cast<double>() - plane).norm(), 1e-6);
    EXPECT_GE(polygons[p].getContour().size(), 3U);
    for (const Point& corner : polygons[p].getContour())
      EXPECT_NEAR(plane.dot(corner.getVector4fMap().cast<double>()), 0.0, 1e-5);
  }
  for (std::size_t k = 0; k < hulls.size(); ++k)
    EXPECT_EQ(hulls[k].getContour().size(), outlines[k].hull.size());
}

TEST_F(AnalysisTest, ContoursOfPlanarRegionsMayBeSimplified)
{
  Segmentation::PlanarRegions all;
  segmentation_.segment(all);
  segmentation_.setSimplifyContours(true);
  Segmentation::PlanarRegions simple;
  segmentation_.segment(simple);
  std::vector<RegionOutline> outlines;
  segmentation_.computeOutlines(outlines);
  ASSERT_EQ(simple.size(), all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_LT(simple[k].getContour().size(), all[k].getContour().size());
    EXPECT_EQ(simple[k].getContour().size(), outlines[k].patches[0].outer.size());
    EXPECT_EQ(simple[k].getCentroid(), all[k].getCentroid());
    EXPECT_EQ(simple[k].getCoefficients(), all[k].getCoefficients());
  }
}

TEST_F(AnalysisTest, StagesEndWithTheResult)
{
  segment();
  pcl_mrf_planes::SegmentationStages stages;
  segmentation_.computeStages(stages);
  ASSERT_FALSE(stages.labels.empty());
  EXPECT_EQ(stages.labels.back().labels, segmentation_.getResult().labels);
  EXPECT_FALSE(stages.tiles.empty());
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> without_result;
  without_result.computeStages(stages);
  EXPECT_TRUE(stages.labels.empty()) << "cleared";
}

TEST_F(AnalysisTest, PatchesAreRegionsOfTheirOwnOnRequest)
{
  segment();
  const auto whole_models = models_;
  const auto wholes = inliers_;
  std::vector<PlaneUncertainty> of_wholes;
  segmentation_.computeUncertainties(of_wholes);
  std::vector<float> whole_confidence;
  segmentation_.computeConfidence(whole_confidence);
  segmentation_.setSeparatePatches(true);
  segmentation_.setMinInliers(30);
  segment();
  ASSERT_GT(models_.size(), whole_models.size()) << "a scene with cut planes is needed";
  std::vector<int> plane_of_point(cloud_->size(), -1);
  for (std::size_t k = 0; k < wholes.size(); ++k)
    for (const auto i : wholes[k].indices)
      plane_of_point[static_cast<std::size_t>(i)] = static_cast<int>(k);
  std::vector<PlaneUncertainty> of_patches;
  segmentation_.computeUncertainties(of_patches);
  ASSERT_EQ(of_patches.size(), models_.size());
  std::vector<RegionOutline> outlines;
  segmentation_.computeOutlines(outlines);
  for (std::size_t k = 0; k < models_.size(); ++k) {
    EXPECT_GE(inliers_[k].indices.size(), 30U);
    EXPECT_EQ(outlines[k].patches.size(), 1U) << "one patch a region";
    const auto plane = static_cast<std::size_t>(
        plane_of_point[static_cast<std::size_t>(inliers_[k].indices[0])]);
    EXPECT_EQ(models_[k].values, whole_models[plane].values);
    EXPECT_EQ(of_patches[k].covariance, of_wholes[plane].covariance)
        << "the plane is known as well as all its patches say";
  }
  std::vector<float> confidence;
  segmentation_.computeConfidence(confidence);
  EXPECT_EQ(confidence, whole_confidence);
}

TEST_F(AnalysisTest, ResultsMoveWithTheCloud)
{
  segment();
  std::vector<PlaneUncertainty> here;
  segmentation_.computeUncertainties(here);
  std::vector<PlaneCrease> creases;
  segmentation_.computeCreases(creases);
  ASSERT_FALSE(creases.empty());
  std::vector<RegionOutline> outlines;
  segmentation_.computeOutlines(outlines);

  const Eigen::Affine3f move =
      Eigen::Translation3f(3, -2, 1) *
      Eigen::AngleAxisf(0.7f, Eigen::Vector3f(1, 2, 3).normalized());
  Cloud::Ptr moved(new Cloud);
  pcl::transformPointCloud(*cloud_, *moved, move);
  moved->sensor_origin_ = Eigen::Vector4f(3, -2, 1, 0);
  moved->sensor_orientation_ = Eigen::Quaternionf(move.rotation());
  segmentation_.setInputCloud(moved);
  segment();
  std::vector<PlaneUncertainty> there;
  segmentation_.computeUncertainties(there);
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t k = 0; k < there.size(); ++k) {
    // That of the points off the border: nearly the region's, if that is large.
    EXPECT_LT((there[k].plane.normal - model(k).head<3>()).norm(), k == 0 ? 5e-3 : 0.1);
    ASSERT_EQ(there[k].valid, here[k].valid);
    const Eigen::Matrix3d turn = move.rotation().cast<double>();
    EXPECT_LT((there[k].plane.normal - turn * here[k].plane.normal).norm(), 1e-3)
        << "in the frame of the cloud";
    if (!here[k].valid)
      continue;
    const double expected = here[k].covariance.topLeftCorner(3, 3).trace();
    EXPECT_NEAR(there[k].covariance.topLeftCorner(3, 3).trace(), expected,
                0.05 * expected);
  }
  std::vector<PlaneCrease> moved_creases;
  segmentation_.computeCreases(moved_creases);
  ASSERT_EQ(moved_creases.size(), creases.size());
  const Eigen::Affine3d move_d = move.cast<double>();
  for (std::size_t k = 0; k < creases.size(); ++k) {
    const Eigen::Vector3d start = move_d * creases[k].start;
    EXPECT_LT(std::fmin((moved_creases[k].start - start).norm(),
                        (moved_creases[k].end - start).norm()),
              0.02);
  }
  std::vector<RegionOutline> moved_outlines;
  segmentation_.computeOutlines(moved_outlines);
  for (std::size_t k = 0; k < outlines.size(); ++k)
    EXPECT_NEAR(moved_outlines[k].patches[0].area, outlines[k].patches[0].area,
                0.02 * outlines[k].patches[0].area);
}

TEST_F(AnalysisTest, ProjectionIsThatOfProjectInliers)
{
  for (std::size_t i = 0; i < cloud_->size(); ++i)
    (*cloud_)[i].r = static_cast<std::uint8_t>(i % 251);
  segment();
  Cloud projected;
  segmentation_.projectOntoPlanes(projected);
  ASSERT_EQ(projected.width, cloud_->width);
  for (std::size_t k = 0; k < models_.size(); ++k) {
    pcl::ProjectInliers<Point> project;
    project.setModelType(pcl::SACMODEL_PLANE);
    project.setInputCloud(cloud_);
    project.setIndices(std::make_shared<pcl::PointIndices>(inliers_[k]));
    project.setModelCoefficients(std::make_shared<pcl::ModelCoefficients>(models_[k]));
    Cloud expected;
    project.filter(expected);
    ASSERT_EQ(expected.size(), inliers_[k].indices.size());
    for (std::size_t p = 0; p < expected.size(); ++p) {
      const Point& mine = projected[static_cast<std::size_t>(inliers_[k].indices[p])];
      ASSERT_LT((mine.getVector3fMap() - expected[p].getVector3fMap()).norm(), 1e-5f);
      ASSERT_EQ(mine.r, expected[p].r) << "other fields stay";
    }
  }
  segmentation_.projectOntoPlanes(*cloud_, ProjectionWay::RAY);
  EXPECT_EQ(cloud_->size(), projected.size()) << "the output may be the input";
}

TEST_F(AnalysisTest, IndicesServeExtractIndices)
{
  segment();
  pcl::PointIndices on_planes;
  pcl::PointIndices rest;
  segmentation_.extractIndices(on_planes, rest);
  pcl::ExtractIndices<Point> extract;
  extract.setInputCloud(cloud_);
  extract.setIndices(std::make_shared<pcl::PointIndices>(rest));
  Cloud left;
  extract.filter(left);
  EXPECT_EQ(left.size(), rest.indices.size());
  for (const Point& point : left)
    ASSERT_TRUE(std::isfinite(point.z)) << "only measured points are left";
  std::size_t inliers = 0;
  for (const pcl::PointIndices& one : inliers_)
    inliers += one.indices.size();
  EXPECT_EQ(on_planes.indices.size(), inliers);
  EXPECT_EQ(on_planes.indices.size() + rest.indices.size(),
            segmentation_.getReport().valid_points);
}

TEST_F(AnalysisTest, WithoutAResultOutputsAreEmpty)
{
  std::vector<PlaneUncertainty> uncertainties(1);
  std::vector<RegionOutline> outlines(1);
  std::vector<PlaneCrease> creases(1);
  std::vector<float> confidence(1);
  Cloud projected(3, 3);
  pcl::PointIndices on_planes;
  on_planes.indices = {1};
  pcl::PointIndices rest = on_planes;
  segmentation_.computeUncertainties(uncertainties);
  segmentation_.computeOutlines(outlines);
  segmentation_.computeCreases(creases);
  segmentation_.computeConfidence(confidence);
  segmentation_.projectOntoPlanes(projected);
  segmentation_.extractIndices(on_planes, rest);
  EXPECT_TRUE(uncertainties.empty() && outlines.empty() && creases.empty() &&
              confidence.empty() && projected.empty() && on_planes.indices.empty() &&
              rest.indices.empty());
}

TEST_F(AnalysisTest, ParametersThatCannotBeAreRefused)
{
  OutlineParameters outline;
  outline.tolerance = -1;
  segmentation_.setOutlineParameters(outline);
  segment();
  EXPECT_TRUE(models_.empty());
  segmentation_.setOutlineParameters(OutlineParameters());
  CreaseParameters crease;
  crease.max_gap = std::nan("");
  segmentation_.setCreaseParameters(crease);
  segment();
  EXPECT_TRUE(models_.empty());
}

/// Corners in axes of the plane.
FlatPolygon flatten(const PlanePolygon& patch, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d right = normal.unitOrthogonal();
  const Eigen::Vector3d up = normal.cross(right);
  const auto flat = [&](const PlaneRing& ring) {
    FlatRing out;
    for (const Eigen::Vector3d& corner : ring)
      out.emplace_back(right.dot(corner), up.dot(corner));
    return out;
  };
  FlatPolygon out = {flat(patch.outer)};
  for (const PlaneRing& hole : patch.holes)
    out.push_back(flat(hole));
  return out;
}

TEST_F(AnalysisTest, HoldsForRealClouds)
{
  const char* folder = std::getenv("PCL_MRF_PLANES_DATA");
  if (folder == nullptr || !std::filesystem::is_directory(folder))
    GTEST_SKIP() << "PCL_MRF_PLANES_DATA names no folder of clouds";
  std::size_t patches = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".pcd")
      continue;
    Cloud::Ptr cloud(new Cloud);
    if (pcl::io::loadPCDFile(entry.path().string(), *cloud) != 0 ||
        !cloud->isOrganized())
      continue;
    segmentation_.setInputCloud(cloud);
    segment();
    std::vector<RegionOutline> outlines;
    segmentation_.computeOutlines(outlines);
    ASSERT_EQ(outlines.size(), models_.size());
    for (std::size_t k = 0; k < outlines.size(); ++k)
      for (const PlanePolygon& patch : outlines[k].patches) {
        EXPECT_TRUE(isValidPolygon(flatten(patch, model(k).head<3>()))) << entry.path();
        ++patches;
      }
    std::vector<PlaneUncertainty> uncertainties;
    segmentation_.computeUncertainties(uncertainties);
    for (const PlaneUncertainty& one : uncertainties)
      EXPECT_TRUE(!one.valid || (one.covariance.allFinite() && one.bias.allFinite()));
    std::vector<float> confidence;
    segmentation_.computeConfidence(confidence);
    EXPECT_EQ(confidence.size(), cloud->size());
  }
  EXPECT_GT(patches, 0U);
}

} // namespace
} // namespace pcl_mrf_planes
