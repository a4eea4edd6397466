// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation_result.h"

#include <ostream>

namespace pcl_mrf_planes::evaluation {

/** \brief The scores, then what else was asked for, a table each, and which frames have
 * no result. A dash: there is nothing to measure. */
void printEvaluation(std::ostream& out, const EvaluationResult& result,
                     const EvaluationOptions& options);

} // namespace pcl_mrf_planes::evaluation
