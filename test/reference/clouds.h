// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/render.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/** Scenes as PCL clouds. */
namespace pcl_mrf_planes::reference {

/** \brief The frame as an organized cloud in the sensor frame. */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr toCloud(const scenes::SceneFrame& frame)
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  cloud->resize(frame.size());
  cloud->width = static_cast<std::uint32_t>(frame.width);
  cloud->height = static_cast<std::uint32_t>(frame.height);
  cloud->is_dense = false;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    (*cloud)[i].x = frame.x[i];
    (*cloud)[i].y = frame.y[i];
    (*cloud)[i].z = frame.z[i];
  }
  return cloud;
}

/** \brief All that segment() gives. */
template <typename PointT>
struct Output {
  using Segmentation = pcl::MRFPlaneSegmentation<PointT>;
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  typename Segmentation::Centroids centroids;
  typename Segmentation::Covariances covariances;
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::PointIndices> label_indices;

  void run(Segmentation& segmentation)
  {
    segmentation.segment(models, inliers, centroids, covariances, labels,
                         label_indices);
  }

  bool empty() const
  {
    return models.empty() && inliers.empty() && centroids.empty() &&
           covariances.empty() && labels.empty() && label_indices.empty();
  }

  std::vector<std::uint32_t> labelValues() const
  {
    std::vector<std::uint32_t> values;
    for (const pcl::Label& label : labels)
      values.push_back(label.label);
    return values;
  }
};

} // namespace pcl_mrf_planes::reference
