// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "study.h"

#include <pcl_mrf_planes/parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief Options of the app with their values, as on its command line. */
using NamedValues = std::vector<std::pair<std::string, std::string>>;

/** \brief The profile DEFAULT with some options changed.
 * \throws std::runtime_error for an unknown name or a value out of its range */
Variant variantOf(const std::string& name, const NamedValues& values);

} // namespace pcl_mrf_planes::benchmarks
