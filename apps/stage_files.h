// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pictures.h"

#include <pcl_mrf_planes/parameters.h>

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Write how a segmentation comes about into a folder: 00_tiles.png, in which green
 * tiles fit best and red ones worst, NN_STAGE.png for the labels after every stage, in
 * colours that planes keep, stages.csv with the energies and tiles.csv.
 *
 * \throws std::runtime_error with what is wrong and what to do */
void writeStages(const std::string& folder, const pcl::PointCloud<pcl::PointXYZ>& cloud,
                 const std::vector<Colour>& colours, const Parameters& parameters);

} // namespace pcl_mrf_planes::apps
