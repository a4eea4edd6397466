// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "region_analysis.h"

#include <nlohmann/json_fwd.hpp>

#include <cstddef>

namespace pcl_mrf_planes::apps {

/** \brief Add what is known of plane \a k to its entry of the report. */
void describePlane(const RegionAnalysis& analysis, std::size_t k,
                   nlohmann::ordered_json& plane);

/** \brief Add the creases, and angles and distances of all pairs of planes. */
void describeCreases(const RegionAnalysis& analysis, nlohmann::ordered_json& report);

} // namespace pcl_mrf_planes::apps
