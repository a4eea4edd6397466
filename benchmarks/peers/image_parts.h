// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief The 4-connected parts of a mask, in the order of their first points.
 * \param[in] mask width times n values, not 0: belongs to it
 * \param[in] min_points smaller parts are left out
 */
std::vector<std::vector<std::size_t>>
connectedParts(const std::vector<std::uint8_t>& mask, std::size_t width,
               std::size_t min_points);

} // namespace pcl_mrf_planes::benchmarks
