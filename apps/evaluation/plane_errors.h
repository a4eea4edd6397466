// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <pcl_mrf_planes/organized_points.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief How far the plane of a region is from that of the true region it matches. */
struct PlaneError {
  std::uint16_t truth = 0; ///< label of the true plane
  std::uint16_t label = 0; ///< label of the matching plane of the result
  double angle = 0.0;      ///< between the two planes, degrees, 0 to 90
  double offset = 0.0;     ///< of the result's plane from the true centroid, metres
};

/** \brief Least-squares planes of the true regions against those of their matches.
 *
 * A true region and a region of the result match when their IoU is above 0.5, as for
 * the panoptic quality. Both planes are fitted to all valid points of their region, the
 * result's to those as well that are not scored. Regions whose points give no plane are
 * left out. O(points).
 *
 * \param[in] points the cloud that was segmented
 * \param[in] min_points true planes with so many points or fewer are left out
 * \return by label of the truth
 * \throws std::invalid_argument when the three differ in size
 */
std::vector<PlaneError> planeErrors(const OrganizedPoints& points,
                                    const LabelImage& truth, const LabelImage& labels,
                                    int min_points = 0);

/** \brief Mean, median and largest of some values; NaN without any. The median of an
 * even number is the mean of the middle two. */
struct ErrorSpread {
  double mean = 0.0;
  double median = 0.0;
  double most = 0.0;
};

/** \brief Spread of values in any order. O(n log n). */
ErrorSpread spreadOf(std::vector<double> values);

/** \brief The errors of many planes in six numbers. */
struct PlaneErrorSummary {
  int planes = 0;
  ErrorSpread angle;  ///< degrees
  ErrorSpread offset; ///< metres
};

/** \brief Every plane counts once, whatever its size and its frame. */
PlaneErrorSummary summarize(const std::vector<PlaneError>& errors);

} // namespace pcl_mrf_planes::evaluation
