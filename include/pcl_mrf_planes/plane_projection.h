// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane_regions.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Which way a point is moved onto its plane. */
enum class ProjectionWay {
  NORMAL, ///< to the nearest point of the plane, as pcl::ProjectInliers
  RAY     ///< along its viewing ray, where the noise of the depth lies
};

/** \brief A point moved onto a plane, metres, sensor frame.
 *
 * Along the ray a point that sees its plane at less than a degree would move far, and one
 * whose ray goes away from its plane would land behind the sensor; these are moved to the
 * nearest point instead. */
PCL_MRF_PLANES_EXPORT Eigen::Vector3d
projectPoint(const Eigen::Vector3d& point, const Plane& plane, ProjectionWay way);

/** \brief Move the points of all regions onto their planes; the others stay. A cloud
 * without the noise of its planes. O(points) */
PCL_MRF_PLANES_EXPORT void projectOntoPlanes(const std::vector<PlaneRegion>& regions,
                                             ProjectionWay way,
                                             OrganizedPoints& points);

/** \brief projectPoint() for the points of some indices, of a cloud whose coordinates are
 * floats in memory: x, y, z of a point follow each other. O(indices)
 * \param[in] plane its axes those of the points, its offset from \a origin
 * \param[in] origin where the plane has its origin, the sensor
 * \param[in] way shortest, or along the ray from \a origin
 * \param[in] indices of the points to move
 * \param[in] stride floats from a point to the next
 * \param[in,out] first x of the first point */
PCL_MRF_PLANES_EXPORT void
projectPoints(const Plane& plane, const Eigen::Vector3d& origin, ProjectionWay way,
              const std::vector<int>& indices, std::size_t stride, float* first);

/** \brief Indices of the points that belong to no region, ascending. O(points)
 * \param[in] points the cloud
 * \param[in] labels per point: 0 no plane
 * \param[in] invalid whether points that were not measured are among them */
PCL_MRF_PLANES_EXPORT std::vector<int>
pointsOfNoPlane(const OrganizedPoints& points, const std::vector<std::uint16_t>& labels,
                bool invalid = false);

} // namespace pcl_mrf_planes
