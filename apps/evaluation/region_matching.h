// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "contingency_table.h"

#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief Two regions that share at least a point. */
struct RegionOverlap {
  std::size_t truth = 0; ///< index into ContingencyTable::truth
  std::size_t label = 0; ///< index into ContingencyTable::labels
  double iou = 0.0;      ///< intersection over union, 0 to 1

  /** \brief No region has two partners like this one. */
  bool isMatch() const { return iou > 0.5; }
};

/** \brief All pairs of a true plane and a plane of the result that share points, by
 * truth, then label.
 *
 * Points on no plane of the truth are not part of the union: where the truth is
 * incomplete they say nothing against a region. O(pairs).
 *
 * \param[in] min_points true planes with so many points or fewer are left out
 */
std::vector<RegionOverlap> planeOverlaps(const ContingencyTable& table, int min_points);

} // namespace pcl_mrf_planes::evaluation
