// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief A profile and its name in benchmarks and tables. */
struct NamedProfile {
  const char* name;
  Profile profile;
};

inline std::vector<NamedProfile> allProfiles()
{
  return {{"FAST", Profile::FAST},
          {"DEFAULT", Profile::DEFAULT},
          {"PAPER", Profile::PAPER}};
}

/** \brief The class for PCL with its outputs, as a program keeps them for a sequence. */
struct ReusedSegmenter {
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;

  explicit ReusedSegmenter(const Parameters& parameters)
  {
    segmentation.setParameters(parameters);
  }

  /** \brief From points in memory to coefficients, indices and labels. */
  void segment(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud)
  {
    segmentation.setInputCloud(cloud);
    segmentation.segment(planes, inliers);
  }
};

} // namespace pcl_mrf_planes::benchmarks
