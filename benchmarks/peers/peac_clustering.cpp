// SPDX-License-Identifier: BSD-3-Clause
#include "peac.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>

namespace pcl_mrf_planes::benchmarks::peac {

namespace {

/// The best partner of a node and the segment that the two make.
struct Partner {
  int node = -1;
  double mse = std::numeric_limits<double>::infinity();
};

/// Algorithm 3: the node of least error first merges with the neighbour that keeps the
/// error least, until that is too much.
class Clustering {
public:
  Clustering(Graph& graph, const Parameters& parameters)
  : graph_(graph)
  , parameters_(parameters)
  , least_cosine_(std::cos(parameters.merge_angle * M_PI / 180.0))
  {
    clusters_.parent.resize(graph.nodes.size());
    std::iota(clusters_.parent.begin(), clusters_.parent.end(), 0);
    for (std::size_t k = 0; k < graph.nodes.size(); ++k)
      if (graph.is_in_use[k])
        push(static_cast<int>(k));
  }

  Clusters run()
  {
    while (!queue_.empty()) {
      const int node = queue_.top().second;
      queue_.pop();
      if (graph_.is_in_use[static_cast<std::size_t>(node)])
        settle(node);
    }
    std::stable_sort(clusters_.planes.begin(), clusters_.planes.end(),
                     [&](int a, int b) { return pointsOf(a) > pointsOf(b); });
    return std::move(clusters_);
  }

private:
  using Entry = std::pair<double, int>; // error, node

  Segment& at(int node) { return graph_.nodes[static_cast<std::size_t>(node)]; }
  double pointsOf(int node) { return at(node).patch.sums.n; }
  void push(int node) { queue_.emplace(at(node).patch.mse, node); }

  Partner bestPartner(int node)
  {
    Partner best;
    const PlanePatch& patch = at(node).patch;
    for (const int other : at(node).neighbours) {
      const PlanePatch& beside = at(other).patch;
      if (std::abs(patch.normal.dot(beside.normal)) < least_cosine_)
        continue;
      ScatterMatrix sums = patch.sums;
      sums += beside.sums;
      const double mse = meanSquaredDistance(sums);
      if (mse < best.mse)
        best = {other, mse};
    }
    return best;
  }

  /// Merge a node with its best partner, or take it out of the graph: as a plane if it
  /// is large enough.
  void settle(int node)
  {
    const Partner partner = bestPartner(node);
    if (partner.node >= 0) {
      Segment merged;
      merged.patch.sums = at(node).patch.sums;
      merged.patch.sums += at(partner.node).patch.sums;
      if (partner.mse < parameters_.mergeMse(merged.patch.sums.centroid().z())) {
        merge(node, partner.node, std::move(merged));
        return;
      }
    }
    if (pointsOf(node) >= parameters_.min_points)
      clusters_.planes.push_back(node);
    remove(node);
  }

  void merge(int a, int b, Segment merged)
  {
    merged.patch.fit();
    std::set_union(at(a).neighbours.begin(), at(a).neighbours.end(),
                   at(b).neighbours.begin(), at(b).neighbours.end(),
                   std::back_inserter(merged.neighbours));
    auto& links = merged.neighbours;
    links.erase(std::remove_if(links.begin(), links.end(),
                               [&](int other) { return other == a || other == b; }),
                links.end());
    remove(a);
    remove(b);
    const int node = static_cast<int>(graph_.nodes.size());
    for (const int other : links)
      at(other).neighbours.push_back(node); // the largest number so far: in order
    graph_.nodes.push_back(std::move(merged));
    graph_.is_in_use.push_back(true);
    clusters_.parent[static_cast<std::size_t>(a)] = node;
    clusters_.parent[static_cast<std::size_t>(b)] = node;
    clusters_.parent.push_back(node);
    push(node);
  }

  /// Take a node and its links out of the graph.
  void remove(int node)
  {
    for (const int other : at(node).neighbours) {
      auto& links = at(other).neighbours;
      links.erase(std::lower_bound(links.begin(), links.end(), node));
    }
    at(node).neighbours.clear();
    graph_.is_in_use[static_cast<std::size_t>(node)] = false;
  }

  Graph& graph_;
  const Parameters& parameters_;
  double least_cosine_;
  Clusters clusters_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

} // namespace

int Clusters::root(int node) const
{
  while (parent[static_cast<std::size_t>(node)] != node)
    node = parent[static_cast<std::size_t>(node)];
  return node;
}

Clusters cluster(Graph& graph, const Parameters& parameters)
{
  return Clustering(graph, parameters).run();
}

} // namespace pcl_mrf_planes::benchmarks::peac
