// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// Corners of a line, each coordinate by itself.
struct FlatLine {
  std::vector<double> x, y;
};

/// Marks the corners from first to last that the line keeps within a tolerance, both ends
/// included (Douglas and Peucker, 1973): those that boost::geometry::simplify keeps, several
/// corners at once. O(corners log corners), O(corners^2) at worst
void keepCorners(const FlatLine& line, std::size_t first, std::size_t last,
                 double tolerance, std::vector<std::uint8_t>& kept);

} // namespace pcl_mrf_planes
