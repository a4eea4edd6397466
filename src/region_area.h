// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"
#include "label_runs.h"

#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/plane.h>

#include <vector>

namespace pcl_mrf_planes {

/// Area of each label's mesh of neighbouring points, projected into its plane, square
/// metres. Four neighbouring points of one label are a face, three of four are a triangle.
///
/// The area of a face is half the sum of p x q over the edges around it, along the normal
/// (Stokes); an edge between two faces is gone round both ways and cancels, so that only
/// the border of the mesh is visited. O(runs + border)
/// \param[in] planes of the labels 0, 1, 2, ...
FrameVector<double> meshAreas(const OrganizedPoints& points,
                              const std::vector<Plane>& planes, const LabelRuns& image,
                              unsigned int threads = 1);

} // namespace pcl_mrf_planes
