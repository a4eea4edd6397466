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

/** \brief Drop what are facets of a curved surface: three or more smaller regions in a row,
 * each meeting the next without a step in a shallow crease. The cells of the regions are
 * not kept. O(points) */
void dropCurvedFans(const OrganizedPoints& points, const NoiseLaw& noise,
                    const AdaptiveParameters& parameters, TileRegions& regions,
                    std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes::adaptive
