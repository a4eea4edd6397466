// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/region_borders.h"
#include "frame_memory.h"

#include <cstddef>

namespace pcl_mrf_planes::adaptive {

/** \brief A border of two regions in a shallow crease and without a step. */
struct Fold {
  std::size_t a, b; ///< regions
  int length;       ///< points
};

/** \brief Which regions have nothing but a surface that goes on around them, in folds that
 * turn in more than one direction, as on a pillow: the sides of a prism turn in one, and
 * end at its top and bottom. O(borders + regions)
 * \param[in] least_share of the border of a region that is in folds, or beyond which the
 * surface goes on without a plane */
FrameVector<bool> findSurroundedFacets(const FittedRegions& regions,
                                       const RegionBorders& borders,
                                       const FrameVector<Fold>& folds,
                                       double least_share);

} // namespace pcl_mrf_planes::adaptive
