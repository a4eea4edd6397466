// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_regions.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// What the second best label of each point would cost more than the one it has, in sigmas;
/// 0 where another would be better; of no meaning for invalid points. The random field's costs with
/// the final planes and labels; see labelConfidence().
/// \param[in] labels 0 no plane, k regions[k - 1]
std::vector<float> labelGaps(const OrganizedPoints& points,
                             const std::vector<PlaneRegion>& regions,
                             const std::vector<std::uint16_t>& labels,
                             const Parameters& parameters);

} // namespace pcl_mrf_planes::adaptive
