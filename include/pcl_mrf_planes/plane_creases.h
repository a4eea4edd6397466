// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane.h>
#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/sensor_pose.h>

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_mrf_planes {

/** \brief The piece of a line along which two planes meet. */
struct PCL_MRF_PLANES_EXPORT PlaneCrease {
  std::size_t first = 0;  ///< index of one region
  std::size_t second = 0; ///< of the other, larger than first
  Eigen::Vector3d start;  ///< one end, metres, sensor frame, on both planes
  Eigen::Vector3d end;    ///< the other end
  double angle = 0.0;     ///< between the normals, radians, 0 to pi
  bool convex = false;    ///< an edge of a box; false: a corner of a room
  int points = 0;         ///< points of the border that lie on it

  /// Metres.
  double length() const { return (end - start).norm(); }
};

/** \brief What counts as a crease. */
struct PCL_MRF_PLANES_EXPORT CreaseParameters {
  double min_angle = 0.17; ///< between the normals, radians, 0 to pi / 2
  /// Of the border's points to the line, metres, > 0; three times the rms distance of the
  /// planes' points where that is more.
  double tolerance = 0.03;
  int reach = 4;        ///< points of no plane that may lie between, >= 0
  int min_points = 8;   ///< of the border on the line, >= 1
  double max_gap = 0.1; ///< where the border may leave the line, metres, > 0

  /** \brief An empty string, or what is wrong and what to choose. */
  std::string validate() const;
};

/** \brief Creases between all regions that touch in the image, by region; several for a
 * pair that meets in several places.
 *
 * Pairs of points of a row or column that carry two labels, with at most reach unlabelled
 * points between them, are the border. What of it lies near the line that both planes
 * share is the crease, from its first point to its last; where one thing stands in front
 * of another the border lies off the line. O(points + border log border)
 */
PCL_MRF_PLANES_EXPORT std::vector<PlaneCrease>
findCreases(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions,
            const CreaseParameters& parameters = {});

/** \brief The same crease in the frame of the cloud. */
PCL_MRF_PLANES_EXPORT PlaneCrease inCloudFrame(const PlaneCrease& crease,
                                               const SensorPose& pose);

/** \brief Angle between the normals of two planes, radians, 0 to pi; the supplement of the
 * one that a protractor shows inside a corner. */
PCL_MRF_PLANES_EXPORT double normalAngle(const Plane& a, const Plane& b);

/** \brief How far apart two nearly parallel regions are: mean distance of the centroid of
 * each from the plane of the other, metres. Of planes that are not parallel it says
 * little. */
PCL_MRF_PLANES_EXPORT double planeDistance(const PlaneRegion& a, const PlaneRegion& b);

/** \brief The line in which two planes meet.
 * \param[in] a, b planes of one frame
 * \param[in] near any point of that frame, metres
 * \param[out] point the point of it nearest to \a near, metres
 * \param[out] direction of unit length
 * \return false for planes that are parallel to 1e-6
 */
PCL_MRF_PLANES_EXPORT bool intersectPlanes(const Plane& a, const Plane& b,
                                           const Eigen::Vector3d& near,
                                           Eigen::Vector3d& point,
                                           Eigen::Vector3d& direction);

} // namespace pcl_mrf_planes
