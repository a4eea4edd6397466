// SPDX-License-Identifier: BSD-3-Clause
//
// pcl::OrganizedMultiPlaneSegmentation: normals from integral images, connected points
// whose normals and offsets agree, then borders refined by distance.
#include "integral_normals.h"
#include "peer_list.h"

#include <pcl/common/angles.h>
#include <pcl/segmentation/organized_multi_plane_segmentation.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

using MultiPlane =
    pcl::OrganizedMultiPlaneSegmentation<pcl::PointXYZ, pcl::Normal, pcl::Label>;
using Refinement =
    pcl::PlaneRefinementComparator<pcl::PointXYZ, pcl::Normal, pcl::Label>;
using Regions = std::vector<pcl::PlanarRegion<pcl::PointXYZ>,
                            Eigen::aligned_allocator<pcl::PlanarRegion<pcl::PointXYZ>>>;

void configure(MultiPlane& segmentation, const Values& values)
{
  segmentation.setMinInliers(static_cast<unsigned>(values.at("min_inliers")));
  segmentation.setAngularThreshold(pcl::deg2rad(values.at("angle")));
  segmentation.setDistanceThreshold(values.at("distance"));
  segmentation.setMaximumCurvature(values.at("curvature"));
  const Refinement::Ptr refinement(new Refinement);
  refinement->setDistanceThreshold(static_cast<float>(values.at("refine_distance")),
                                   false);
  segmentation.setRefinementComparator(refinement);
}

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  MultiPlane segmentation;
  configure(segmentation, values);
  Regions regions;
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers, label_indices, boundaries;
  pcl::PointCloud<pcl::Label>::Ptr region_labels(new pcl::PointCloud<pcl::Label>);
  const Stopwatch watch;
  segmentation.setInputNormals(integralNormals(cloud, values));
  segmentation.setInputCloud(cloud);
  segmentation.segmentAndRefine(regions, planes, inliers, region_labels, label_indices,
                                boundaries);
  milliseconds = watch.milliseconds();

  Labels labels(cloud->size(), 0);
  for (std::size_t k = 0; k < inliers.size(); ++k)
    for (const pcl::index_t i : inliers[k].indices)
      labels[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
  return labels;
}

} // namespace

Peer makePclMultiPlane()
{
  // Angle in degrees, distances in metres; "distance" is multiplied by the squared
  // depth (in metres), "refine_distance" is not.
  return {"pcl_multi_plane",
          "pcl::OrganizedMultiPlaneSegmentation, segmentAndRefine()",
          {{"published",
            "defaults of the class; normals as in PCL's "
            "openni_organized_multi_plane_segmentation",
            {{"min_inliers", 1000},
             {"angle", 3},
             {"distance", 0.02},
             {"curvature", 0.001},
             {"refine_distance", 0.02},
             {"smoothing", 20},
             {"depth_change", 0.03}}},
           {"tuned",
            "best of tune_peers.py",
            {{"min_inliers", 500},
             {"angle", 1.5},
             {"distance", 0.08},
             {"curvature", 0.01},
             {"refine_distance", 0.01},
             {"smoothing", 20},
             {"depth_change", 0.02}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
