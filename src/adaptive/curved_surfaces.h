// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/plane_merging.h"

namespace pcl_mrf_planes::adaptive {

/** \brief Drop what is no plane of its own after all: facets of curved surfaces, that is
 * smaller regions which meet the next one, or points of no plane, without a step in a
 * shallow crease; regions that a quadric explains; and planes for which too little speaks.
 * The cells of the regions are not kept. O(points) */
void dropDoubtfulPlanes(const OrganizedPoints& points, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, TileRegions& regions,
                        std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes::adaptive
