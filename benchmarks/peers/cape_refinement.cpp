// SPDX-License-Identifier: BSD-3-Clause
#include "cape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_mrf_planes::benchmarks::cape {

namespace {

using Mask = std::vector<bool>; // a value for each cell

/// Cells all of whose neighbours belong to the segment, too.
Mask innerCells(const Segment& segment, const BlockGrid& grid)
{
  Mask all(grid.size(), false), inner(grid.size(), false);
  for (const int cell : segment.cells)
    all[static_cast<std::size_t>(cell)] = true;
  for (const int cell : segment.cells) {
    bool is_inner = true;
    for (const int beside : grid.neighbours(cell))
      is_inner = is_inner && (beside < 0 || all[static_cast<std::size_t>(beside)]);
    inner[static_cast<std::size_t>(cell)] = is_inner;
  }
  return inner;
}

/// The cells of a segment and the eight around each.
Mask widened(const Segment& segment, const BlockGrid& grid)
{
  Mask wide(grid.size(), false);
  for (const int cell : segment.cells) {
    const int row = cell / grid.columns(), column = cell % grid.columns();
    for (int r = std::max(0, row - 1); r <= std::min(grid.rows() - 1, row + 1); ++r)
      for (int c = std::max(0, column - 1);
           c <= std::min(grid.columns() - 1, column + 1); ++c)
        wide[static_cast<std::size_t>(grid.block(r, c))] = true;
  }
  return wide;
}

/// Gives points to planes.
class Assignment {
public:
  Assignment(const Cloud& cloud, const BlockGrid& grid)
  : cloud_(cloud)
  , grid_(grid)
  , labels_(cloud.size(), 0)
  , distance_(cloud.size(), std::numeric_limits<float>::max())
  {}

  /// All points of a cell, for good.
  void fill(int cell, std::uint16_t label)
  {
    forPointsOf(cell, [&](std::size_t i) {
      labels_[i] = label;
      distance_[i] = -1.0f;
    });
  }

  /// Points of a cell within three sigma of the plane, unless another is nearer.
  void assign(int cell, const PlanePatch& plane, std::uint16_t label)
  {
    const double most = 9.0 * plane.mse;
    forPointsOf(cell, [&](std::size_t i) {
      const double distance = std::abs(plane.distance(cloud_[i]));
      if (distance * distance < most && distance < static_cast<double>(distance_[i])) {
        labels_[i] = label;
        distance_[i] = static_cast<float>(distance);
      }
    });
  }

  Labels takeLabels() { return std::move(labels_); }

private:
  template <typename Visit>
  void forPointsOf(int cell, Visit visit)
  {
    const int top = grid_.firstRow(cell), left = grid_.firstColumn(cell);
    for (int row = top; row < top + grid_.side; ++row)
      for (int column = left; column < left + grid_.side; ++column) {
        const std::size_t i = grid_.point(row, column);
        if (std::isfinite(cloud_[i].z))
          visit(i);
      }
  }

  const Cloud& cloud_;
  const BlockGrid& grid_;
  Labels labels_;
  std::vector<float> distance_;
};

} // namespace

Labels refine(const Cloud& cloud, const std::vector<Segment>& segments,
              const BlockGrid& grid)
{
  Assignment assignment(cloud, grid);
  std::uint16_t label = 0;
  for (const Segment& segment : segments) {
    const Mask inner = innerCells(segment, grid);
    if (std::find(inner.begin(), inner.end(), true) == inner.end())
      continue;
    ++label;
    const Mask wide = widened(segment, grid);
    for (int cell = 0; cell < static_cast<int>(grid.size()); ++cell)
      if (inner[static_cast<std::size_t>(cell)])
        assignment.fill(cell, label);
      else if (wide[static_cast<std::size_t>(cell)])
        assignment.assign(cell, segment.patch, label);
  }
  return assignment.takeLabels();
}

} // namespace pcl_mrf_planes::benchmarks::cape
