// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation_result.h"

namespace pcl_mrf_planes::evaluation {

/** \brief Write a line of comma-separated values for each frame, set and mean, and a
 * header; an empty value: there is nothing to measure. Whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do
 */
void writeCsv(const std::string& path, const EvaluationResult& result);

/** \brief Write everything as JSON, frames with their files and matching planes; null:
 * there is nothing to measure. Whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do
 */
void writeJson(const std::string& path, const EvaluationResult& result,
               const EvaluationOptions& options);

} // namespace pcl_mrf_planes::evaluation
