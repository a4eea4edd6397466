// SPDX-License-Identifier: BSD-3-Clause
#include "peac.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace pcl_mrf_planes::benchmarks::peac {

namespace {

constexpr int NONE = -1;

/// Index of the plane of each block, NONE: no plane.
std::vector<int> planesOfBlocks(const Graph& graph, const Clusters& clusters)
{
  std::vector<int> plane_of_node(graph.nodes.size(), NONE);
  for (std::size_t k = 0; k < clusters.planes.size(); ++k)
    plane_of_node[static_cast<std::size_t>(clusters.planes[k])] = static_cast<int>(k);
  std::vector<int> planes(graph.grid.size());
  for (std::size_t block = 0; block < planes.size(); ++block)
    planes[block] =
        plane_of_node[static_cast<std::size_t>(clusters.root(static_cast<int>(block)))];
  return planes;
}

/// Blocks beside one of another plane or none are taken away: they may lie across a
/// border.
std::vector<int> eroded(const BlockGrid& grid, const std::vector<int>& planes)
{
  std::vector<int> result = planes;
  for (std::size_t block = 0; block < planes.size(); ++block)
    for (const int beside : grid.neighbours(static_cast<int>(block)))
      if (beside >= 0 && planes[static_cast<std::size_t>(beside)] != planes[block])
        result[block] = NONE;
  return result;
}

/// Planes grow from their blocks point by point, in the order of a queue; a point goes
/// to the nearest plane that reaches it.
class Growth {
public:
  Growth(const Cloud& cloud, const Graph& graph, const Clusters& clusters,
         const Parameters& parameters)
  : cloud_(cloud)
  , grid_(graph.grid)
  , blocks_(eroded(grid_, planesOfBlocks(graph, clusters)))
  , plane_(cloud.size(), NONE)
  , distance_(cloud.size(), std::numeric_limits<float>::max())
  , least_cosine_(std::cos(parameters.refine_angle * M_PI / 180.0))
  {
    for (const int node : clusters.planes)
      planes_.push_back({graph.nodes[static_cast<std::size_t>(node)].patch, {}});
    for (std::size_t block = 0; block < blocks_.size(); ++block)
      if (blocks_[block] != NONE)
        fillBlock(static_cast<int>(block));
  }

  void run()
  {
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const auto [row, column, plane] = queue_[next];
      reach(row, column - 1, plane);
      reach(row, column + 1, plane);
      reach(row - 1, column, plane);
      reach(row + 1, column, plane);
    }
  }

  /// The grown planes, with links between those that met. Planes without a block left
  /// are not in use.
  Graph graphOfPlanes()
  {
    Graph result;
    result.nodes = planes_;
    result.is_in_use.assign(planes_.size(), false);
    for (const int plane : blocks_)
      if (plane != NONE)
        result.is_in_use[static_cast<std::size_t>(plane)] = true;
    for (Segment& node : result.nodes)
      std::sort(node.neighbours.begin(), node.neighbours.end());
    return result;
  }

  const std::vector<int>& planeOfPoints() const { return plane_; }

private:
  struct Seed {
    int row, column, plane;
  };

  /// Give the points of a block to its plane. Those on a side where the plane may grow
  /// are seeds.
  void fillBlock(int block)
  {
    const int plane = blocks_[static_cast<std::size_t>(block)];
    const int top = grid_.firstRow(block), left = grid_.firstColumn(block);
    const int last = grid_.side - 1;
    const auto grows = [&](int row, int column) {
      return row >= 0 && column >= 0 && row < grid_.height && column < grid_.width &&
             !isInside(row, column);
    };
    for (int row = top; row <= top + last; ++row)
      for (int column = left; column <= left + last; ++column) {
        plane_[grid_.point(row, column)] = plane;
        if ((row == top && grows(row - 1, column)) ||
            (row == top + last && grows(row + 1, column)) ||
            (column == left && grows(row, column - 1)) ||
            (column == left + last && grows(row, column + 1)))
          queue_.push_back({row, column, plane});
      }
  }

  /// Whether a point lies in a block that erosion has left.
  bool isInside(int row, int column) const
  {
    const int block = grid_.blockAt(row, column);
    return block >= 0 && blocks_[static_cast<std::size_t>(block)] != NONE;
  }

  /// Let a plane have a point, if it is near and no nearer plane has it.
  void reach(int row, int column, int plane)
  {
    if (row < 0 || column < 0 || row >= grid_.height || column >= grid_.width)
      return;
    const std::size_t point = grid_.point(row, column);
    const int owner = plane_[point];
    if (owner == plane || isInside(row, column))
      return;
    constexpr double ROUNDING = 1e-11; // square metres
    const PlanePatch& patch = planes_[static_cast<std::size_t>(plane)].patch;
    const double distance = std::abs(patch.distance(cloud_[point]));
    if (!(distance * distance < 9.0 * patch.mse + ROUNDING)) // three sigma
      return;
    if (owner != NONE)
      meet(owner, plane);
    if (distance < static_cast<double>(distance_[point])) {
      plane_[point] = plane;
      distance_[point] = static_cast<float>(distance);
      queue_.push_back({row, column, plane});
    }
  }

  /// Planes that reach the same point may be one.
  void meet(int a, int b)
  {
    Segment& first = planes_[static_cast<std::size_t>(a)];
    Segment& second = planes_[static_cast<std::size_t>(b)];
    if (std::abs(first.patch.normal.dot(second.patch.normal)) < least_cosine_ ||
        std::find(first.neighbours.begin(), first.neighbours.end(), b) !=
            first.neighbours.end())
      return;
    first.neighbours.push_back(b);
    second.neighbours.push_back(a);
  }

  const Cloud& cloud_;
  BlockGrid grid_;
  std::vector<int> blocks_; // plane of each block that erosion has left
  std::vector<int> plane_;  // of each point
  std::vector<float> distance_;
  std::vector<Segment> planes_;
  std::vector<Seed> queue_;
  double least_cosine_;
};

} // namespace

Labels refine(const Cloud& cloud, const Graph& graph, const Clusters& clusters,
              const Parameters& parameters)
{
  Growth growth(cloud, graph, clusters, parameters);
  growth.run();
  Graph planes = growth.graphOfPlanes();
  const Clusters merged = cluster(planes, parameters);
  std::vector<std::uint16_t> label_of_node(planes.nodes.size(), 0);
  for (std::size_t k = 0; k < merged.planes.size(); ++k)
    label_of_node[static_cast<std::size_t>(merged.planes[k])] =
        static_cast<std::uint16_t>(k + 1);
  std::vector<std::uint16_t> label_of_plane;
  for (std::size_t plane = 0; plane < clusters.planes.size(); ++plane)
    label_of_plane.push_back(
        label_of_node[static_cast<std::size_t>(merged.root(static_cast<int>(plane)))]);
  Labels labels(cloud.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (growth.planeOfPoints()[i] != NONE && std::isfinite(cloud[i].z))
      labels[i] = label_of_plane[static_cast<std::size_t>(growth.planeOfPoints()[i])];
  return labels;
}

} // namespace pcl_mrf_planes::benchmarks::peac
