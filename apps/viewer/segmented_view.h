// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view_frame.h"

#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_creases.h>
#include <pcl_mrf_planes/region_polygons.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief What the viewer says of a plane, in the frame of the cloud. */
struct ViewPlane {
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ(); ///< unit length, towards the sensor
  double d = 0.0;               ///< metres
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  std::size_t points = 0;
  double area = 0.0; ///< square metres
  double rms = 0.0;  ///< metres
};

/** \brief One standard deviation of a plane's parameters; infinite where its points do not
 * determine it. */
struct PlaneDeviations {
  double normal = 0.0; ///< about the axis that is known least, radians
  double offset = 0.0; ///< of d, metres
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero(); ///< of (a, b, c, d)
};

/** \brief A segmented frame, by whatever method. */
struct SegmentedView {
  std::string method;                ///< for the title
  std::vector<std::uint16_t> labels; ///< per point: 0 no plane, k planes[k - 1]
  std::vector<ViewPlane> planes;     ///< largest area first
  std::vector<std::pair<std::string, double>> stage_ms;
  /// Confidence of every label, 0 to 1, worked out when it is asked for; may be empty.
  std::function<std::vector<float>()> confidence;
  /// How well every plane is known, worked out when it is asked for; may be empty.
  std::function<std::vector<PlaneDeviations>()> deviations;
  /// Where planes meet, in the frame of the cloud; as above.
  std::function<std::vector<PlaneCrease>()> creases;
  /// Patches with holes, and convex hulls; as above.
  std::function<std::vector<RegionOutline>()> outlines;
  /// The cloud with its points moved onto their planes along their rays; as above.
  std::function<pcl::PointCloud<pcl::PointXYZ>::ConstPtr()> projected;

  double totalMs() const;
};

/** \brief Segment a frame.
 * \param[in] method name for the title
 * \throws std::runtime_error when there is not enough memory */
SegmentedView segmentView(const ViewFrame& frame, const Parameters& parameters,
                          const std::string& method);

/** \brief Signed distance of point \a index to the plane of its label, metres; NaN where
 * there is none. */
double distanceToPlane(const ViewFrame& frame, const SegmentedView& view,
                       std::size_t index);

/** \brief One standard deviation of the place of a plane where \a point lies on it, along
 * the normal, metres. */
double deviationAt(const Eigen::Vector3d& point, const PlaneDeviations& deviations);

} // namespace pcl_mrf_planes::viewer
