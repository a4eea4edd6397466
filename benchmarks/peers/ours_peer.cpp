// SPDX-License-Identifier: BSD-3-Clause
//
// This library, by its class for PCL. The labels come with coefficients and indices, as
// a program gets them.
#include "ours_peer.h"
#include "peer_list.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

namespace pcl_mrf_planes::benchmarks {

Labels segmentByClass(const Cloud::ConstPtr& cloud, const Parameters& parameters,
                      double& milliseconds)
{
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setParameters(parameters);
  segmentation.setNumberOfThreads(1);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  const Stopwatch watch;
  segmentation.setInputCloud(cloud);
  segmentation.segment(planes, inliers);
  milliseconds = watch.milliseconds();

  Labels labels(cloud->size(), 0);
  for (std::size_t k = 0; k < inliers.size(); ++k)
    for (const pcl::index_t i : inliers[k].indices)
      labels[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
  return labels;
}

namespace {

constexpr const char* PROFILE = "profile"; // 0 DEFAULT, 1 FAST, 2 PAPER

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  const double number = values.at(PROFILE);
  const Profile profile = number == 2.0   ? Profile::PAPER
                          : number == 1.0 ? Profile::FAST
                                          : Profile::DEFAULT;
  return segmentByClass(cloud, Parameters::fromProfile(profile), milliseconds);
}

} // namespace

Peer makeOurs()
{
  return {"mrf_planes",
          "this library",
          {{"paper", "profile PAPER", {{PROFILE, 2.0}}},
           {"fast", "profile FAST", {{PROFILE, 1.0}}},
           {"default", "profile DEFAULT", {{PROFILE, 0.0}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
