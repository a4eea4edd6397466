// SPDX-License-Identifier: BSD-3-Clause
#include "peac.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl_mrf_planes::benchmarks::peac {

namespace {

constexpr double RADIANS = M_PI / 180.0; // a degree in radians

double squared(double value)
{
  return value * value;
}

bool isValid(const pcl::PointXYZ& point)
{
  return std::isfinite(point.z) && std::isfinite(point.x) && std::isfinite(point.y);
}

/// Whether a step in depth lies between a point and one beside it, if that is valid.
bool isStep(const pcl::PointXYZ& point, const pcl::PointXYZ& other,
            const Parameters& parameters)
{
  return std::abs(point.z - other.z) >
         parameters.depthStep(0.5 * (std::abs(point.z) + std::abs(other.z)));
}

/// The sums of a block; none if points are missing or steps in it, algorithm 2,
/// RejectNode.
std::optional<ScatterMatrix> sumsOf(const Cloud& cloud, const BlockGrid& grid,
                                    int block, const Parameters& parameters)
{
  ScatterMatrix sums;
  const int first_row = grid.firstRow(block), first_column = grid.firstColumn(block);
  for (int row = first_row; row < first_row + grid.side; ++row)
    for (int column = first_column; column < first_column + grid.side; ++column) {
      const auto* point = &cloud.points[grid.point(row, column)];
      if (!isValid(*point)) {
        if (!parameters.loose_start)
          return std::nullopt;
        continue;
      }
      if ((column + 1 < grid.width && isStep(point[0], point[1], parameters)) ||
          (row + 1 < grid.height && isStep(point[0], point[grid.width], parameters)))
        return std::nullopt;
      sums.add(point->x, point->y, point->z);
    }
  const double least = parameters.loose_start ? 0.5 * squared(grid.side) : 1.0;
  return sums.n > least ? std::optional(sums) : std::nullopt;
}

/// Walks along a row or a column of blocks and links them: three in a row, if none is
/// missing and the normals of the outer two agree, RejectEdge. The next three start at
/// the last of these, or, at a crease, one block on; what is left at the end is a pair.
class ChainOfBlocks {
public:
  ChainOfBlocks(Graph& graph, const Parameters& parameters, int first, int stride,
                int count)
  : graph_(graph)
  , parameters_(parameters)
  , first_(first)
  , stride_(stride)
  , count_(count)
  {}

  void link()
  {
    for (int start = 0; start + 1 < count_;) {
      const int last = std::min(start + 2, count_ - 1);
      if (const int missing = lastMissing(start, last); missing >= start)
        start = missing + 1;
      else if (!agree(start, last))
        ++start;
      else
        for (; start < last; ++start)
          linkWithNext(start);
    }
  }

private:
  int node(int place) const { return first_ + place * stride_; }

  const PlanePatch& patch(int place) const
  {
    return graph_.nodes[static_cast<std::size_t>(node(place))].patch;
  }

  /// The last place of a range whose block was rejected, less than the first: none.
  int lastMissing(int first, int last) const
  {
    while (last >= first && graph_.is_in_use[static_cast<std::size_t>(node(last))])
      --last;
    return last;
  }

  bool agree(int start, int last) const
  {
    return std::abs(patch(start).normal.dot(patch(last).normal)) >=
           parameters_.startCosine(patch(start + 1).centre.z());
  }

  void linkWithNext(int place)
  {
    const int a = node(place), b = node(place + 1);
    graph_.nodes[static_cast<std::size_t>(a)].neighbours.push_back(b);
    graph_.nodes[static_cast<std::size_t>(b)].neighbours.push_back(a);
  }

  Graph& graph_;
  const Parameters& parameters_;
  int first_, stride_, count_; // the blocks by their numbers
};

} // namespace

double Parameters::startMse(double z) const
{
  return squared(depth_sigma * z * z + start_tolerance);
}

double Parameters::mergeMse(double z) const
{
  return squared(depth_sigma * z * z + merge_tolerance);
}

double Parameters::startCosine(double z) const
{
  const double share =
      (std::clamp(z, near_depth, far_depth) - near_depth) / (far_depth - near_depth);
  return std::cos(RADIANS * (near_angle + share * (far_angle - near_angle)));
}

Graph makeGraph(const Cloud& cloud, const Parameters& parameters)
{
  Graph graph;
  graph.grid = {static_cast<int>(cloud.width), static_cast<int>(cloud.height),
                parameters.block_side};
  const int blocks = static_cast<int>(graph.grid.size());
  graph.nodes.resize(graph.grid.size());
  graph.is_in_use.assign(graph.grid.size(), false);
  for (int block = 0; block < blocks; ++block)
    if (const auto sums = sumsOf(cloud, graph.grid, block, parameters)) {
      PlanePatch& patch = graph.nodes[static_cast<std::size_t>(block)].patch;
      patch.sums = *sums;
      patch.fit();
      graph.is_in_use[static_cast<std::size_t>(block)] =
          patch.mse < parameters.startMse(patch.centre.z());
    }
  const int rows = graph.grid.rows(), columns = graph.grid.columns();
  for (int row = 0; row < rows; ++row)
    ChainOfBlocks(graph, parameters, row * columns, 1, columns).link();
  for (int column = 0; column < columns; ++column)
    ChainOfBlocks(graph, parameters, column, columns, rows).link();
  for (Segment& node : graph.nodes)
    std::sort(node.neighbours.begin(), node.neighbours.end());
  return graph;
}

} // namespace pcl_mrf_planes::benchmarks::peac
