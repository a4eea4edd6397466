// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_clustering.h>
#include <pcl_mrf_planes/row_propagation.h>
#include <pcl_mrf_planes/tile_plane_detection.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

// Stages of Method::PAPER as in the public headers, in memory that is there already: what
// is written is the same whatever it held.

void detectTilePlanes(const OrganizedPoints& points, const Parameters& parameters,
                      TileImage& image);

void clusterTilePlanes(const TileImage& image, const Parameters& parameters,
                       PlaneClusters& clusters);

void propagateRows(const FieldRows& field, int iterations, unsigned int threads,
                   std::vector<std::uint16_t>& labels);

} // namespace pcl_mrf_planes
