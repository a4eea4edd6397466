// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes {

/// Where a row of labels changes: every k with labels[k] != labels[k - 1], 1 <= k < count,
/// ascending. \param[out] places room for count - 1 of them \return how many there are
/// O(count), many labels at once; the same for every instruction set.
std::size_t findChanges(const std::uint16_t* labels, std::size_t count,
                        std::uint32_t* places);

} // namespace pcl_mrf_planes
