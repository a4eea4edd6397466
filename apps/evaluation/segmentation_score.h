// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"
#include "region_counts.h"

#include <limits>

namespace pcl_mrf_planes::evaluation {

/** \brief What a score leaves to choose. */
struct ScoreOptions {
  double tolerance = 0.8; ///< of the region counts, above 0.5, at most 1
  int min_points = 0;     ///< planes with so many points or fewer are left out, >= 0
  bool complete = true;   ///< whether the truth has every plane, which clutter needs
};

/** \brief How well a result agrees with the truth; NaN: there is nothing to measure. */
struct SegmentationScore {
  static constexpr double NONE = std::numeric_limits<double>::quiet_NaN();

  RegionCounts counts;
  /** Panoptic quality of the planes, 0 to 1 (Kirillov et al., CVPR 2019): the sum of
   * the IoU of the matches, IoU > 0.5, over matches + half of the planes without match.
   * Points on no plane of the truth don't count against a region; regions that lie
   * mostly on such points are not counted. 1 where there is no plane in both. */
  double pq = NONE;
  /** Segmentation covering, 0 to 1 (Arbelaez et al., PAMI 2011): the best IoU of each
   * true plane, weighted by its points. 1 without true planes. */
  double sc = NONE;
  /** Rand index, 0 to 1: share of the pairs of points that both images put together or
   * both put apart (Arbelaez et al., PAMI 2011). Over points on a true plane. */
  double ri = NONE;
  /** Variation of information, nats, >= 0, small is good (Meila, "Comparing
   * clusterings", 2007). Over points on a true plane. */
  double voi = NONE;
  double recall = NONE;  ///< share of the points on a true plane that carry a plane
  double clutter = NONE; ///< share of the points on no true plane that carry a plane
};

/** \brief Hold a result against the truth; see compareLabels() for what is judged.
 *
 * Expected time O(points).
 *
 * \throws std::invalid_argument when the images differ in size or an option is out of
 *         its range
 */
SegmentationScore scoreLabels(const LabelImage& truth, const LabelImage& labels,
                              const ScoreOptions& options = {});

/** \brief The same for images that were compared already. O(n log n) in the number of
 * pairs of labels. */
SegmentationScore scoreTable(const ContingencyTable& table,
                             const ScoreOptions& options = {});

} // namespace pcl_mrf_planes::evaluation
