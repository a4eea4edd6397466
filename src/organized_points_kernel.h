// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/organized_points.h>

#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes {

/// Where the coordinates of the points of an OrganizedPoints go.
struct PointPlanes {
  float* x;
  float* y;
  float* z;
  std::uint8_t* valid;
};

/// Loads points that lie \a stride numbers apart, x, y and z in a row, those that are not
/// finite or beyond OrganizedPoints::FARTHEST as invalid. \return how many, from the first
/// on: up to four at the end are left to the caller
std::size_t loadPoints(const float* first, std::size_t stride, std::size_t count,
                       const PointPlanes& out);

} // namespace pcl_mrf_planes
