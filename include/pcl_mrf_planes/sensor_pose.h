// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes {

/** \brief Where the sensor was in the frame of the cloud: p_cloud = rotation * p_sensor
 * + origin. */
struct PCL_MRF_PLANES_EXPORT SensorPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); ///< of sensor to cloud
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();       ///< metres
};

/** \brief A point of an organized cloud and its place in the image. */
struct PCL_MRF_PLANES_EXPORT Sighting {
  Eigen::Vector3d point; ///< metres, frame of the cloud
  Eigen::Vector2d pixel; ///< column, row
};

/** \brief False if the points fill so small an angle, seen from \a origin, that no
 * sensor of organized clouds can have been there: the cloud was moved and its pose was
 * not.
 *
 * The limit is an rms radius of 1/20 of the distance, a field of view of some six
 * degrees. O(sightings)
 */
PCL_MRF_PLANES_EXPORT bool plausibleOrigin(const std::vector<Sighting>& sightings,
                                           const Eigen::Vector3d& origin);

/** \brief Find the pose of a pinhole camera from its own cloud.
 *
 * A depth camera keeps every point on the ray of its pixel, noise or not, so the 3x4
 * projection matrix follows from points and pixels by the direct linear transform
 * (Hartley and Zisserman, Multiple View Geometry, 2nd ed., section 7.1). The origin is
 * its null vector, the optical axis the third row of its left 3x3 block; rotation about
 * the axis is arbitrary, as nothing depends on it.
 *
 * \param[in] sightings at least six, not all on one plane
 * \param[out] pose set on success
 * \return false where no camera at a plausible origin explains the points to a pixel:
 * lidars, planar scenes, parallel rays
 */
PCL_MRF_PLANES_EXPORT bool estimatePinholePose(const std::vector<Sighting>& sightings,
                                               SensorPose& pose);

} // namespace pcl_mrf_planes
