// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_cloud.h"

namespace pcl_mrf_planes::apps {

/** \brief segmentCloud() for a scan whose last column is the neighbour of its first.
 *
 * The scan is segmented with a margin on either side that repeats the columns of the
 * other side, so that no plane ends at the seam. A plane that got two labels, one on each
 * side of it, is what most points of the margin have in common with the points they
 * repeat: the two are joined, and the plane is fitted anew to its points.
 *
 * Energies and counts of tiles are those of the scan with its margins.
 *
 * \throws std::runtime_error as segmentCloud()
 */
SegmentedCloud segmentWrapped(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                              const Parameters& parameters, int repeat);

} // namespace pcl_mrf_planes::apps
