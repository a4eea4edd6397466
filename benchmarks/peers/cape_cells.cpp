// SPDX-License-Identifier: BSD-3-Clause
#include "cape.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::benchmarks::cape {

namespace {

constexpr double RADIANS = M_PI / 180.0; // a degree in radians

/// Whether a line of points of a cell crosses a step: more than one of them jumps in
/// depth from the last that did not. A single stray point is no step.
bool hasStep(const Cloud& cloud, std::size_t first, std::size_t stride, int count,
             double largest)
{
  int jumps = 0;
  float last = NAN;
  for (int k = 0; k < count; ++k) {
    const float z = cloud[first + static_cast<std::size_t>(k) * stride].z;
    if (std::abs(z - last) >= largest)
      ++jumps;
    else if (std::isfinite(z))
      last = z;
  }
  return jumps > 1;
}

/// Between opposite corners, whichever two have a depth.
double diameterOf(const Cloud& cloud, std::size_t first, std::size_t width, int side)
{
  const std::size_t last = static_cast<std::size_t>(side - 1);
  const auto distance = [&](std::size_t a, std::size_t b) {
    return static_cast<double>(
        (cloud[a].getVector3fMap() - cloud[b].getVector3fMap()).norm());
  };
  const double down = distance(first, first + last * width + last);
  return std::isfinite(down) ? down : distance(first + last, first + last * width);
}

Cell fitCell(const Cloud& cloud, std::size_t first, const Parameters& parameters)
{
  Cell cell;
  const std::size_t width = cloud.width;
  const int side = parameters.cell_side;
  ScatterMatrix& sums = cell.patch.sums;
  for (int row = 0; row < side; ++row) {
    const auto* point = &cloud.points[first + static_cast<std::size_t>(row) * width];
    for (int column = 0; column < side; ++column, ++point)
      if (std::isfinite(point->z))
        sums.add(point->x, point->y, point->z);
  }
  const std::size_t middle = static_cast<std::size_t>(side / 2);
  if (2.0 * sums.n < side * side ||
      hasStep(cloud, first + middle * width, 1, side, parameters.depth_step) ||
      hasStep(cloud, first + middle, width, side, parameters.depth_step))
    return cell;
  cell.patch.fit();
  const double z = cell.patch.centre.z();
  const double tolerance = parameters.depth_sigma * z * z + parameters.cell_tolerance;
  cell.is_planar = cell.patch.mse <= tolerance * tolerance;
  const double off =
      diameterOf(cloud, first, width, side) * std::sin(RADIANS * parameters.angle);
  cell.reach = std::min(std::max(parameters.least_distance, off), // NaN: the least
                        parameters.most_distance);
  return cell;
}

} // namespace

std::vector<Cell> fitCells(const Cloud& cloud, const BlockGrid& grid,
                           const Parameters& parameters)
{
  std::vector<Cell> cells;
  cells.reserve(grid.size());
  for (int cell = 0; cell < static_cast<int>(grid.size()); ++cell)
    cells.push_back(fitCell(
        cloud, grid.point(grid.firstRow(cell), grid.firstColumn(cell)), parameters));
  return cells;
}

} // namespace pcl_mrf_planes::benchmarks::cape
