// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <vector>

namespace pcl_mrf_planes::adaptive {

/// What speaks for final labels and planes.
struct LabelGaps {
  /// What the second best label of each point would cost more than the one it has, in
  /// sigmas; 0 where another would be better; of no meaning for invalid points.
  std::vector<float> gaps;
  /// Of the plane of each region, in points of independent noise; see evidenceOf().
  std::vector<double> evidence;
};

/// The random field's costs with the final planes and labels; see labelConfidence().
/// \param[in] result its regions and labels, and the noise if it has it
LabelGaps labelGaps(const OrganizedPoints& points, const PlaneSegmentation& result,
                    const Parameters& parameters);

} // namespace pcl_mrf_planes::adaptive
