// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/tile_sums.h"

#include <pcl_mrf_planes/organized_points.h>

#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief The ten sums of all whole 4x4 cells of the image. */
void sumAllCells(const OrganizedPoints& points, std::vector<adaptive::TileSums>& sums);

} // namespace pcl_mrf_planes::benchmarks
