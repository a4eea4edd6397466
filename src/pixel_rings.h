// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_runs.h"

#include <vector>

namespace pcl_mrf_planes {

/// A corner of pixels: (x, y) is the upper left one of pixel (x, y).
struct PixelCorner {
  int x, y;
  int pixel;    ///< of the part, beside the edge that leaves the corner
  bool touched; ///< two pixels of the part meet here by their corners only
};

/// The borders of a part along the edges of its pixels: the outer one first, then one
/// around each hole; the part lies to the right (image axes: y down) of every edge.
using PixelRings = std::vector<std::vector<PixelCorner>>;

/// Rings of all parts, from edge to edge. Where pixels of a part meet by their corners only
/// the ring stays with the background: so no ring meets itself, and rings meet in single
/// corners at most, as polygons of the OGC simple features have it. O(runs + corners), and memory for every point
/// \param[in] parts connectRuns(image)
std::vector<PixelRings> tracePixelRings(const LabelRuns& image, const RunParts& parts);

} // namespace pcl_mrf_planes
