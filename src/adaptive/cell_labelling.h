// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/plane_merging.h"

namespace pcl_mrf_planes::adaptive {

/** \brief Labels the cells, by the random field of the points made coarse: a cell is a site,
 * its data cost follows from its ten sums, its edges are as long as its sides. Then the
 * planes are fitted again to their cells, and those that are none are dropped.
 *
 * Iterated conditional modes (Besag, "On the Statistical Analysis of Dirty Pictures",
 * 1986), down the image and up again: a plane may take cell after cell as far as it fits
 * them. O(cells); cells between others of their own label cost next to nothing. */
TileRegions labelCells(const TileRegions& regions,
                       const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                       const AdaptiveParameters& parameters, unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
