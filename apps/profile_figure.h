// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pictures.h"

#include <pcl_mrf_planes/parameters.h>

namespace pcl_mrf_planes::apps {

/** \brief The row of the paper's Figures 4 to 6, colour, depth and labels, with the
 * parameters of its section V, and the same row with profile DEFAULT under it. A plane
 * that both find has one colour.
 *
 * \param[in] cloud as it was read
 * \param[in] colours one for each point, or none
 * \param[in] parameters what counts as depth, and threads
 * \throws std::runtime_error if it cannot be segmented
 */
Picture profileFigure(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                      const std::vector<Colour>& colours, const Parameters& parameters);

} // namespace pcl_mrf_planes::apps
