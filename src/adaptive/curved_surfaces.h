// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/region_refinement.h"

namespace pcl_mrf_planes::adaptive {

/** \brief Drop what is no plane of its own after all: facets of curved surfaces, that is
 * smaller regions which meet the next one, or points of no plane, without a step in a
 * shallow crease; regions that a quadric explains; and planes for which too little speaks.
 * O(points) */
void dropDoubtfulPlanes(const OrganizedPoints& points, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, FittedRegions& regions,
                        LabelledPoints& image, unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
