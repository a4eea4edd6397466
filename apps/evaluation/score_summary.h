// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmentation_score.h"

#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief Scores of one or many frames; see SegmentationScore for what they are. */
struct ScoreSummary {
  static constexpr double NONE = SegmentationScore::NONE;

  int frames = 0;
  double ratio = NONE; ///< correct regions of all frames over true planes of all
  double truth = NONE, correct = NONE, over = NONE, under = NONE, missed = NONE,
         noise = NONE; ///< regions a frame
  double pq = NONE, sc = NONE, ri = NONE, voi = NONE, recall = NONE, clutter = NONE;
};

/** \brief A number of a summary and the name it goes by in tables and files. */
struct ScoreColumn {
  const char* name;
  double ScoreSummary::*value;
};

/** \brief All numbers but the frames, in the order of tables. */
const std::vector<ScoreColumn>& scoreColumns();

/** \brief Mean of each number over the frames that have it; NaN if none has. */
ScoreSummary summarize(const std::vector<SegmentationScore>& scores);

/** \brief Mean of each number, ratio as well, over the sets that have it: a set counts
 * as much as another whatever its size. */
ScoreSummary meanOfSets(const std::vector<ScoreSummary>& sets);

} // namespace pcl_mrf_planes::evaluation
