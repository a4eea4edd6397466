// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <string>

namespace pcl_mrf_planes::evaluation {

/** \brief Read a gray PNG of 16 bits a point; no gamma or colour profile is applied.
 * \throws std::runtime_error with what is wrong and what to do, without the file's name
 */
LabelImage readLabelPng(const std::string& path);

} // namespace pcl_mrf_planes::evaluation
