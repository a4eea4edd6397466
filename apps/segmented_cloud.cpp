// SPDX-License-Identifier: BSD-3-Clause
#include "segmented_cloud.h"

#include <stdexcept>

namespace pcl_mrf_planes::apps {

SegmentedCloud segmentCloud(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud,
                            const Parameters& parameters, int repeat,
                            const RegionOptions& region_options)
{
  using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;
  Segmentation segmentation;
  segmentation.setParameters(parameters);
  segmentation.setInputCloud(cloud);
  segmentation.setSeparatePatches(region_options.separate_patches);
  segmentation.setOutlineParameters(region_options.outline);
  segmentation.setCreaseParameters(region_options.crease);

  SegmentedCloud result;
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  std::vector<pcl::PointIndices> label_indices;
  Segmentation::Centroids centroids;
  Segmentation::Covariances covariances;
  for (int run = 0; run < repeat; ++run) {
    segmentation.segment(models, inliers, centroids, covariances, result.labels,
                         label_indices);
    if (result.labels.size() != cloud->size()) // no other reason is left
      throw std::runtime_error("cannot be segmented in the memory there is (" +
                               std::to_string(cloud->size()) +
                               " points); cut it into parts or raise "
                               "--merge-threshold");
    result.timing.add(segmentation.getReport().stage_ms);
    analyseRegions(segmentation, region_options, result.analysis);
    result.analysis_timing.add(result.analysis.stage_ms);
  }
  result.report = segmentation.getReport();
  if (result.report.valid_points == 0)
    throw std::runtime_error("has no valid point within 1000 km of the sensor; "
                             "coordinates must be in metres");
  const auto& regions = segmentation.getResult().regions;
  for (std::size_t k = 0; k < models.size(); ++k)
    result.planes.push_back({Eigen::Vector4f(models[k].values.data()), centroids[k],
                             inliers[k].indices.size(), regions[k].area,
                             regions[k].rms});
  return result;
}

} // namespace pcl_mrf_planes::apps
