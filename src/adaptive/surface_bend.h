// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/tile_sums.h"
#include "frame_memory.h"
#include "label_runs.h"

#include <pcl_mrf_planes/organized_points.h>

namespace pcl_mrf_planes::adaptive {

/** \brief How much a region bends, by a quadric over its own plane. */
struct Bend {
  double angle = 0; ///< turning of the normal from end to end [rad]
  double share = 0; ///< share of the squared distances that the quadric explains
};

/** \brief Bend of every region by the runs of its label; label k refers to planes[k - 1].
 * Every second point of every second row is used, of large regions half or a quarter of
 * these each way. O(points). */
FrameVector<Bend> measureBends(const OrganizedPoints& points, const LabelRuns& image,
                               const FrameVector<FittedPlane>& planes,
                               unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
