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
      const auto* point =
          &cloud.points[static_cast<std::size_t>(row * grid.width + column)];
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

void link(Graph& graph, int a, int b)
{
  graph.nodes[static_cast<std::size_t>(a)].neighbours.push_back(b);
  graph.nodes[static_cast<std::size_t>(b)].neighbours.push_back(a);
}

/// Link a block with those on both sides of it unless one is missing or the normals of
/// the outer two disagree: a crease. RejectEdge.
void linkThrough(Graph& graph, int before, int block, int after,
                 const Parameters& parameters)
{
  if (before < 0 || after < 0)
    return;
  for (const int node : {before, block, after})
    if (!graph.is_in_use[static_cast<std::size_t>(node)])
      return;
  const PlanePatch& first = graph.nodes[static_cast<std::size_t>(before)].patch;
  const PlanePatch& middle = graph.nodes[static_cast<std::size_t>(block)].patch;
  const PlanePatch& last = graph.nodes[static_cast<std::size_t>(after)].patch;
  if (std::abs(first.normal.dot(last.normal)) <
      parameters.startCosine(middle.centre.z()))
    return;
  link(graph, before, block);
  link(graph, block, after);
}

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
  for (int block = 0; block < blocks; ++block) {
    const auto [left, right, upper, lower] = graph.grid.neighbours(block);
    linkThrough(graph, left, block, right, parameters);
    linkThrough(graph, upper, block, lower, parameters);
  }
  for (Segment& node : graph.nodes) { // two centres may link the same pair
    std::sort(node.neighbours.begin(), node.neighbours.end());
    node.neighbours.erase(std::unique(node.neighbours.begin(), node.neighbours.end()),
                          node.neighbours.end());
  }
  return graph;
}

} // namespace pcl_mrf_planes::benchmarks::peac
