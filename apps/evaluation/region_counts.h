// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "contingency_table.h"

#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief How the regions of a result stand to those of the truth.
 *
 * Classes of Hoover et al., "An Experimental Comparison of Range Image Segmentation
 * Algorithms", PAMI 1996: correct + over + the true planes in groups of under + missed
 * = truth.
 */
struct RegionCounts {
  int truth = 0;   ///< planes of the truth
  int correct = 0; ///< pairs of regions that cover each other
  int over = 0;    ///< true planes that lie in several regions of the result
  int under = 0;   ///< regions of the result over several true planes
  int missed = 0;  ///< true planes in none of these classes
  int noise = 0;   ///< regions of the result in none of these classes
};

/** \brief Give each region one class: correct first, then over, then under.
 *
 * O(n log n) in the number of pairs of labels.
 *
 * \param[in] tolerance share of points that must agree, above 0.5 (so that no region
 *            fits two others), at most 1
 * \param[in] min_points planes with so many points or fewer are left out, >= 0
 * \throws std::invalid_argument when one of them is out of its range
 */
RegionCounts countRegions(const ContingencyTable& table, double tolerance,
                          int min_points);

/** \brief The counts at one tolerance, of a curve over them. */
struct CurvePoint {
  double tolerance = 0.0;
  RegionCounts counts;
};

/** \brief 0.51, then 0.55 to 0.95 in steps of 0.05: the tolerances of the figures of
 * Hoover et al. */
std::vector<double> curveTolerances();

/** \brief countRegions() at each of curveTolerances(). */
std::vector<CurvePoint> toleranceCurve(const ContingencyTable& table, int min_points);

} // namespace pcl_mrf_planes::evaluation
