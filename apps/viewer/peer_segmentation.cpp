// SPDX-License-Identifier: BSD-3-Clause
#include "peer_segmentation.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

using Clock = std::chrono::steady_clock;
using Regions = std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
                            Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>;

double msSince(Clock::time_point start)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

pcl::PointCloud<pcl::Normal>::Ptr normalsOf(const ViewFrame& frame)
{
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02f);
  estimation.setNormalSmoothingSize(20.0f);
  estimation.setInputCloud(frame.cloud);
  estimation.compute(*normals);
  return normals;
}

ViewPlane planeOf(const pcl::ModelCoefficients& model, const pcl::PointIndices& inliers,
                  const pcl::PointCloud<pcl::PointXYZ>& cloud)
{
  ViewPlane plane;
  const Eigen::Vector4d c = Eigen::Vector4f(model.values.data()).cast<double>();
  const double length = c.head<3>().norm();
  plane.normal = c.head<3>() / length;
  plane.d = c[3] / length;
  plane.points = inliers.indices.size();
  double squares = 0.0;
  for (const int i : inliers.indices) {
    const Eigen::Vector3d p =
        cloud[static_cast<std::size_t>(i)].getVector3fMap().cast<double>();
    plane.centroid += p / static_cast<double>(plane.points);
    squares += std::pow(plane.normal.dot(p) + plane.d, 2);
  }
  plane.rms = std::sqrt(squares / static_cast<double>(plane.points));
  return plane;
}

} // namespace

SegmentedView segmentByPcl(const ViewFrame& frame)
{
  SegmentedView view;
  view.method = "pcl::OrganizedMultiPlaneSegmentation";
  view.labels.assign(frame.cloud->size(), 0);
  const Clock::time_point start = Clock::now();
  const pcl::PointCloud<pcl::Normal>::Ptr normals = normalsOf(frame);
  view.stage_ms.emplace_back("normals", msSince(start));
  const Clock::time_point middle = Clock::now();
  pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label> planes;
  planes.setMinInliers(500);
  planes.setAngularThreshold(0.05236); // 3 degrees
  planes.setDistanceThreshold(0.02);   // metres
  planes.setInputNormals(normals);
  planes.setInputCloud(frame.cloud);
  Regions regions;
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers, label_indices, boundaries;
  pcl::PointCloud<pcl::Label>::Ptr labels(new pcl::PointCloud<pcl::Label>);
  planes.segmentAndRefine(regions, models, inliers, labels, label_indices, boundaries);
  view.stage_ms.emplace_back("planes", msSince(middle));
  for (std::size_t k = 0; k < models.size() && k < inliers.size(); ++k) {
    if (inliers[k].indices.empty())
      continue;
    view.planes.push_back(planeOf(models[k], inliers[k], *frame.cloud));
    for (const int i : inliers[k].indices)
      view.labels[static_cast<std::size_t>(i)] =
          static_cast<std::uint16_t>(view.planes.size());
  }
  return view;
}

} // namespace pcl_mrf_planes::viewer
