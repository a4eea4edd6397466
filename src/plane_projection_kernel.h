// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_mrf_planes {

/// A plane as seen from the sensor: n . (p - origin) + d = 0.
struct ProjectionTarget {
  double normal[3], d;
  double origin[3];
  /// Sine of the least angle between ray and plane for a point to move along its ray, if the
  /// plane is ahead on it;
  /// otherwise it moves along the normal. Infinite: all move along the normal.
  double grazing;
};

/// Moves the points of some indices onto a plane; the coordinates of a point follow each
/// other, and those of the next point come \a stride numbers later. The same bits for every
/// instruction set. O(count)
void projectPoints(const ProjectionTarget& target, const int* indices,
                   std::size_t count, std::size_t stride, float* first);

} // namespace pcl_mrf_planes
