// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/sensor_pose.h>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Corners of a closed polygon on a plane, metres; the first is not repeated. */
using PlaneRing = std::vector<Eigen::Vector3d>;

/** \brief One connected patch of a plane as a polygon with holes. */
struct PCL_MRF_PLANES_EXPORT PlanePolygon {
  PlaneRing outer;              ///< counterclockwise, seen from the sensor
  std::vector<PlaneRing> holes; ///< clockwise
  double area = 0.0;            ///< less the holes, square metres
  int points = 0;               ///< of the patch
};

/** \brief The shape of a region. */
struct PCL_MRF_PLANES_EXPORT RegionOutline {
  std::vector<PlanePolygon> patches; ///< most points first
  PlaneRing hull; ///< convex hull of all of the patches, counterclockwise
};

/** \brief What outlines leave out; lengths in metres, areas in square metres. */
struct PCL_MRF_PLANES_EXPORT OutlineParameters {
  double tolerance = 0.01; ///< a corner is left out if the line stays so near it, >= 0
  int min_points = 1;      ///< smaller patches have no polygon
  double min_area = 0.0;   ///< nor have those of less area
  double min_hole_area = 0.0; ///< smaller holes are filled

  /** \brief An empty string, or what is wrong and what to choose. */
  std::string validate() const;
};

/** \brief Outline every region.
 *
 * The borders of the pixels of a patch, in which no ring meets itself, are seen along
 * their rays onto the plane: so noise of the depth has no say, and half a pixel around
 * the outermost points belongs to the patch. Simplified after Douglas and Peucker (The
 * Canadian Cartographer 10(2), 1973) to the tolerance; where that makes rings cross, to a
 * half of it, and so on. Every polygon is valid by the OGC simple feature rules
 * (boost::geometry::is_valid): closed, without self-intersection, holes inside.
 *
 * Of a patch whose rays cross each other, as no sensor's do, the convex hull is given.
 * O(points + border log border)
 */
PCL_MRF_PLANES_EXPORT std::vector<RegionOutline>
outlineRegions(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions,
               const OutlineParameters& parameters = {});

/** \brief The same outline in the frame of the cloud. */
PCL_MRF_PLANES_EXPORT RegionOutline inCloudFrame(const RegionOutline& outline,
                                                 const SensorPose& pose);

} // namespace pcl_mrf_planes
