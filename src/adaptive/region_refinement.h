// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/plane_merging.h"

namespace pcl_mrf_planes::adaptive {

/** \brief After labelling: small components of a label lose it, planes are fitted again
 * to their points, those that are not planar given the noise or too small are dropped.
 * labels are renumbered 1..planes.size(); cell_region of the result follows the labels. */
TileRegions refineRegions(const OrganizedPoints& points, const TileLevel& cells,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes::adaptive
