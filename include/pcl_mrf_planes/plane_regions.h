// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane.h>

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief In place of a label plane's index: the point is on no plane. */
constexpr std::uint16_t NO_PLANE = 65535;

/** \brief The points that carry the label of one plane. */
struct PCL_MRF_PLANES_EXPORT PlaneRegion {
  Plane plane;                ///< sensor frame
  int label = 0;              ///< index of the label plane
  std::vector<int> indices;   ///< points of the image, ascending
  double area = 0.0;          ///< of the surface in the plane, square metres
  double rms = 0.0;           ///< root mean square distance of the points, metres
  Eigen::Vector3d centroid;   ///< metres, sensor frame
  Eigen::Matrix3d covariance; ///< of the points, square metres
};

/** \brief Gather the regions of the label planes, largest area first; ties by number of
 * points, then by the first point. Labels that won no point, fewer than
 * \a min_points, or less than \a min_area square metres give no region.
 *
 * The area is that of the mesh of neighbouring points, projected into the plane: noise
 * along the viewing ray cancels, sampling density has no say.
 * O(points + planes)
 *
 * \param[in] points the cloud in the sensor frame
 * \param[in] planes the label planes
 * \param[in] labels index of a label plane for every valid point, or NO_PLANE
 * \param[in] min_points, min_area what a region needs, >= 0
 */
PCL_MRF_PLANES_EXPORT std::vector<PlaneRegion>
gatherRegions(const OrganizedPoints& points, const std::vector<Plane>& planes,
              const std::vector<std::uint16_t>& labels, int min_points,
              double min_area = 0.0);

/** \brief The label image of the regions: 0 no plane, k region k - 1. */
PCL_MRF_PLANES_EXPORT std::vector<std::uint16_t>
regionLabels(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions);

} // namespace pcl_mrf_planes
