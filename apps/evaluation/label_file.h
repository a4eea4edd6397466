// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <pcl_mrf_planes/organized_points.h>

#include <string>

namespace pcl_mrf_planes::evaluation {

/** \brief Read labels from a 16-bit gray PNG, or from the field label of an organized
 * PCD file when the name ends in .pcd.
 * \throws std::runtime_error with the file's name, what is wrong and what to do
 */
LabelImage readLabels(const std::string& path);

/** \brief The points of an organized PCD file, moved so that one of them is the origin:
 * the frame does not matter to a fit, but its distance to its precision.
 * \throws std::runtime_error with the file's name, what is wrong and what to do
 */
OrganizedPoints readPoints(const std::string& path);

} // namespace pcl_mrf_planes::evaluation
