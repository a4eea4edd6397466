// SPDX-License-Identifier: BSD-3-Clause
/** \file Objects on a table, as PCL's organized segmentation demo finds them: planes first,
 * then what is connected and is no large plane. The class that finds the planes is a
 * parameter: pcl::OrganizedMultiPlaneSegmentation or pcl::MRFPlaneSegmentation. */
#pragma once

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl/features/integral_image_normal.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/euclidean_cluster_comparator.h>
#include <pcl/segmentation/organized_connected_component_segmentation.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using PclPlanes = pcl::OrganizedMultiPlaneSegmentation<Point, pcl::Normal, pcl::Label>;
using MrfPlanes = pcl::MRFPlaneSegmentation<Point>;
using PlanarRegions = std::vector<pcl::PlanarRegion<Point>,
                                  Eigen::aligned_allocator<pcl::PlanarRegion<Point>>>;

struct TableScene {
  PlanarRegions regions; ///< planes with their contours
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> objects; ///< largest first
};

/** \brief PCL's planes need normals. */
inline void prepare(PclPlanes& planes, const Cloud::ConstPtr& cloud)
{
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::IntegralImageNormalEstimation<Point, pcl::Normal> estimation;
  estimation.setNormalEstimationMethod(estimation.COVARIANCE_MATRIX);
  estimation.setMaxDepthChangeFactor(0.02f);
  estimation.setNormalSmoothingSize(10.0f);
  estimation.setInputCloud(cloud);
  estimation.compute(*normals);
  planes.setMinInliers(1000);
  planes.setAngularThreshold(0.05);
  planes.setDistanceThreshold(0.02);
  planes.setInputNormals(normals);
}

/** \brief Ours need nothing. */
inline void prepare(MrfPlanes&, const Cloud::ConstPtr&) {}

/** \brief Planes, and the things that are not part of a large one.
 * \param[in] large_plane points of a plane that is no object's face
 * \param[in] smallest points of an object
 */
template <typename Planes>
TableScene findObjects(const Cloud::ConstPtr& cloud, std::size_t large_plane = 10000,
                       std::size_t smallest = 300)
{
  TableScene scene;
  Planes planes;
  prepare(planes, cloud);
  planes.setInputCloud(cloud);
  std::vector<pcl::PointIndices> inliers;
  std::vector<pcl::PointIndices> label_indices;
  std::vector<pcl::PointIndices> boundaries;
  pcl::PointCloud<pcl::Label>::Ptr labels(new pcl::PointCloud<pcl::Label>);
  planes.segmentAndRefine(scene.regions, scene.models, inliers, labels, label_indices,
                          boundaries);

  using Comparator = pcl::EuclideanClusterComparator<Point, pcl::Label>;
  // Since PCL 1.10 the set holds the labels that are not excluded, whatever its name says.
  Comparator::ExcludeLabelSetPtr clustered(new Comparator::ExcludeLabelSet);
  for (std::size_t label = 0; label < label_indices.size(); ++label)
    if (label_indices[label].indices.size() <= large_plane)
      clustered->insert(static_cast<std::uint32_t>(label));
  Comparator::Ptr comparator(new Comparator);
  comparator->setInputCloud(cloud);
  comparator->setLabels(labels);
  comparator->setExcludeLabels(clustered);
  comparator->setDistanceThreshold(0.02f, false);

  pcl::PointCloud<pcl::Label> object_labels;
  std::vector<pcl::PointIndices> parts;
  pcl::OrganizedConnectedComponentSegmentation<Point, pcl::Label> components(
      comparator);
  components.setInputCloud(cloud);
  components.segment(object_labels, parts);
  for (const pcl::PointIndices& part : parts) {
    // Points of large planes are parts, too: each on its own.
    if (part.indices.size() >= smallest)
      scene.objects.push_back(part);
  }
  std::stable_sort(scene.objects.begin(), scene.objects.end(),
                   [](const pcl::PointIndices& a, const pcl::PointIndices& b) {
                     return a.indices.size() > b.indices.size();
                   });
  return scene;
}
