// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/label_image.h"
#include "evaluation/region_counts.h"
#include "evaluation/segmentation_score.h"

#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief One method on one frame. */
struct Result {
  std::string method, setting, set, frame;
  int width = 0;
  int height = 0;
  double milliseconds = 0.0;
  std::optional<evaluation::SegmentationScore> score; ///< none without ground truth
  std::vector<evaluation::CurvePoint> curve;          ///< with the score
};

/** \brief Hold the labels of a frame against its truth. */
void scoreAgainst(const evaluation::LabelImage& truth,
                  const evaluation::LabelImage& labels, Result& result);

/** \brief A CSV that has its name only once it is complete: until then it grows under
 * the name with ".part" behind. */
class ResultFile {
public:
  /** \param[in] path the complete file's
   * \param[in] names of the columns for Result::method and Result::setting
   * \throws std::runtime_error when it cannot be written */
  explicit ResultFile(const std::string& path,
                      const std::string& names = "method,setting");
  void add(const Result& result);
  /** \throws std::runtime_error when something was not written */
  void finish();

private:
  std::string path_;
  std::ofstream stream_;
};

/** \brief A line for each method and setting: panoptic quality of each set, their mean,
 * and the median time at 640x480. */
std::string summaryOf(const std::vector<Result>& results);

} // namespace pcl_mrf_planes::benchmarks
