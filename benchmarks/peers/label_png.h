// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/label_image.h"

#include <string>

namespace pcl_mrf_planes::benchmarks {

/** \brief Read a gray PNG of 8 or 16 bits as labels.
 * \throws std::runtime_error with the file's name and what is wrong */
evaluation::LabelImage readLabelPng(const std::string& path);

/** \brief Write labels as a gray PNG of 16 bits.
 * \throws std::runtime_error with the file's name */
void writeLabelPng(const std::string& path, const evaluation::LabelImage& image);

} // namespace pcl_mrf_planes::benchmarks
