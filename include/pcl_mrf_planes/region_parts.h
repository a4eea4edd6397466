// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane_regions.h>

#include <vector>

namespace pcl_mrf_planes {

/** \brief Tell the separate patches of each plane apart: the 4-connected parts of the
 * regions, as regions of their own, largest area first.
 *
 * A part keeps the plane of its region, and PlaneRegion::label is the index of that
 * region. Parts with fewer than \a min_points points or less than \a min_area square
 * metres are dropped; of more than 65000 the largest by points stay. O(points)
 */
PCL_MRF_PLANES_EXPORT std::vector<PlaneRegion>
separateParts(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions,
              int min_points = 1, double min_area = 0.0);

} // namespace pcl_mrf_planes
