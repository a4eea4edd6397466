// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmentation_score.h"

#include <string>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief What the command line of pcl_mrf_plane_evaluation asks for. */
struct EvaluationOptions {
  bool help = false;
  bool version = false;
  std::vector<std::string> files; ///< truth, labels, truth, labels ...
  std::string truth;              ///< a folder; empty: none, as for the others
  std::string labels;
  std::string cloud;
  std::vector<std::string> suffixes = {"gt.png", "faces.png", "pgt.png"};
  ScoreOptions score;
  std::vector<int> borders; ///< points
  bool curve = false;
  bool each = false;
  bool quiet = false;
  std::string csv;
  std::string json;
};

/** \brief Read the command line.
 * \throws apps::UsageError with what is wrong and what to do
 */
EvaluationOptions parseEvaluationOptions(int argc, const char* const argv[]);

/** \brief The text of --help. */
std::string evaluationHelp();

} // namespace pcl_mrf_planes::evaluation
