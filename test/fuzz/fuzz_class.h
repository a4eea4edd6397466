// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fuzz_bytes.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <pcl/console/print.h>

#include <cmath>
#include <vector>

namespace pcl_mrf_planes::fuzz {

using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;

/** \brief What holds for any input: a label for each point or none at all, points of
 * planes within the cloud, finite planes of unit normals. */
inline void requireSound(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                         const std::vector<pcl::ModelCoefficients>& planes,
                         const std::vector<pcl::PointIndices>& inliers)
{
  require(planes.size() == inliers.size(), "planes and their points differ in number");
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const std::vector<float>& v = planes[k].values;
    require(v.size() == 4, "a plane without four coefficients");
    const float norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    require(std::abs(norm - 1.0f) < 1e-3f, "a normal that is not of unit length");
    require(std::isfinite(v[3]), "an offset that is not finite");
    require(!inliers[k].indices.empty(), "a plane without points");
    for (const int i : inliers[k].indices)
      require(i >= 0 && static_cast<std::size_t>(i) < cloud.size(),
              "a point outside of the cloud");
  }
}

/** \brief All that can be asked of a segmentation after a run. */
inline void analyse(Segmentation& segmentation, std::size_t points)
{
  std::vector<PlaneUncertainty> uncertainties;
  segmentation.computeUncertainties(uncertainties);
  std::vector<RegionOutline> outlines;
  segmentation.computeOutlines(outlines);
  std::vector<PlaneCrease> creases;
  segmentation.computeCreases(creases);
  std::vector<float> confidence;
  segmentation.computeConfidence(confidence);
  require(confidence.empty() || confidence.size() == points,
          "confidences of another number of points");
  for (const float c : confidence)
    require(c >= 0.0f && c <= 1.0f, "a confidence outside of 0 to 1");
  pcl::PointCloud<pcl::PointXYZ> projected;
  segmentation.projectOntoPlanes(projected);
  segmentation.projectOntoPlanes(projected, ProjectionWay::RAY);
  Segmentation::PlanarPolygons polygons;
  segmentation.computeHulls(polygons);
}

/** \brief Segments \a cloud and checks what comes out of it, and all that can be asked
 * afterwards.
 * \return the number of planes
 */
inline std::size_t segmentSoundly(Segmentation& segmentation,
                                  const pcl::PointCloud<pcl::PointXYZ>::Ptr& cloud)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> planes;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(planes, inliers);
  requireSound(*cloud, planes, inliers);
  analyse(segmentation, cloud->size());
  return planes.size();
}

} // namespace pcl_mrf_planes::fuzz
