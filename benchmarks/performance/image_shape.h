// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/organized_points.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief Size of an organized cloud and what kind of sensor saw it. */
struct ImageShape {
  int width;
  int height;
  bool lidar = false; ///< a full turn in equal angles instead of a Kinect's picture

  /** \brief "camera:640x480", as it stands in the names of the benchmarks. */
  std::string name() const;
};

inline bool operator<(const ImageShape& a, const ImageShape& b)
{
  return a.name() < b.name();
}

/** \brief The usual size of a depth camera. */
constexpr ImageShape VGA = {640, 480};

/** \brief From a fourth of VGA's width to three times it, and a rotating lidar. */
std::vector<ImageShape> allShapes();

/** \brief The same generated room as a sensor of this shape sees it, with the noise of a
 * Kinect, or 1 cm along the ray for a lidar. Made once for each shape. */
const Cloud::ConstPtr& roomCloud(const ImageShape& shape);

/** \brief The same room as the stages below the class read it. Made once for each shape.
 */
const OrganizedPoints& roomPoints(const ImageShape& shape);

} // namespace pcl_mrf_planes::benchmarks
