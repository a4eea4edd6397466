// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "border_agreement.h"
#include "evaluation_options.h"
#include "frame_list.h"
#include "plane_errors.h"
#include "score_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief Everything measured on one frame. */
struct FrameResult {
  FrameFiles files;
  SegmentationScore score;
  std::vector<CurvePoint> curve;        ///< empty unless asked for
  std::vector<BorderAgreement> borders; ///< for each distance asked for
  std::vector<PlaneError> planes;       ///< empty without clouds
};

/** \brief Means of a border agreement; NaN: no frame has any. */
struct BorderSummary {
  int distance = 0; ///< points
  double precision = ScoreSummary::NONE;
  double recall = ScoreSummary::NONE;
  double f = ScoreSummary::NONE;
};

/** \brief One row of the tables: a frame, a set, or a mean over several. */
struct ResultRow {
  std::string kind; ///< frame, set, mean of sets or all frames
  std::string set;
  std::string name; ///< of a frame
  bool has_labels = true;
  ScoreSummary scores;
  std::vector<BorderSummary> borders;
  PlaneErrorSummary planes;
  std::vector<CurvePoint> curve; ///< counts of all frames added up

  /** \brief What tables call it. */
  std::string title() const;
};

/** \brief All rows. */
struct EvaluationResult {
  std::vector<FrameResult> frames;
  std::vector<ResultRow> frame_rows;
  std::vector<ResultRow> set_rows;       ///< empty unless there are sets
  std::optional<ResultRow> mean_of_sets; ///< the same
  ResultRow all;
  std::vector<std::string> without_labels; ///< names of frames that have no result

  /** \brief Frames, sets, mean of sets, all frames. */
  std::vector<ResultRow> rows(bool with_frames) const;
};

/** \brief Read and score one frame. A frame without labels counts as empty.
 * \throws std::runtime_error with the file's name, what is wrong and what to do
 */
FrameResult scoreFrame(const FrameFiles& files, const EvaluationOptions& options);

/** \brief Sum up over sets and over all. */
EvaluationResult summarizeFrames(std::vector<FrameResult> frames);

} // namespace pcl_mrf_planes::evaluation
