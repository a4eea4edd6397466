// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief Label of points of the ground truth that are not to be scored. */
constexpr std::uint16_t NOT_SCORED = 65535;

/** \brief One label for each point of an organized cloud, row by row from the top.
 *
 * 0 is no plane, k >= 1 plane k; numbers may be left out. In a result 65535 is a plane
 * as any other.
 */
struct LabelImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> labels; ///< width times height of them

  /** \brief Number of points. */
  std::size_t size() const { return labels.size(); }
};

} // namespace pcl_mrf_planes::evaluation
