// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <evaluation/label_image.h>

#include <string>

namespace pcl_mrf_planes::test {

/** \brief Write a label image as a 16-bit gray PNG, in folders that are made for it. */
void writeLabels(const std::string& path, const evaluation::LabelImage& image);

/** \brief Write it as the field label of an organized PCD file, each point a corner of a
 * grid one centimetre wide, two metres away. */
void writeLabelCloud(const std::string& path, const evaluation::LabelImage& image);

} // namespace pcl_mrf_planes::test
