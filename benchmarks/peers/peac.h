// SPDX-License-Identifier: BSD-3-Clause
/** \file Planes by agglomerative clustering of blocks, after Feng, Taguchi and Kamat,
 * "Fast plane extraction in organized point clouds using agglomerative hierarchical
 * clustering", ICRA 2014 (known as PEAC): our own implementation of what the paper
 * describes, not the authors' program.
 *
 * The sections and algorithms named in comments are the paper's.
 */
#pragma once

#include "block_grid.h"
#include "plane_patch.h"

#include <vector>

namespace pcl_mrf_planes::benchmarks::peac {

/** \brief Lengths in metres, angles in degrees. The defaults are the published ones. */
struct Parameters {
  int block_side = 10;         ///< points
  bool loose_start = false;    ///< blocks may lack up to half of their points
  int min_points = 3000;       ///< of a plane
  double depth_sigma = 0.0016; ///< of the standard deviation of depth, 1/m
  double start_tolerance = 0.005;
  double merge_tolerance = 0.008; ///< added to depth_sigma z^2
  double near_depth = 0.5, far_depth = 4.0;
  double near_angle = 15.0, far_angle = 90.0; ///< between blocks, by depth
  double merge_angle = 60.0;                  ///< between segments that merge
  double refine_angle = 30.0; ///< between segments that meet while they grow
  double depth_change = 0.04; ///< between neighbouring points, share of the depth
  double depth_change_offset = 0.00002; ///< as published with the program; the paper's
                                        ///< 2 alpha (z + 0.5) would be 0.02

  /** \brief Largest mean squared distance of a block, or of a segment, from its plane;
   * section III-A, T_MSE. */
  double startMse(double z) const;
  double mergeMse(double z) const;

  /** \brief Least cosine between the normals of blocks that are linked; T_ANG. */
  double startCosine(double z) const;

  /** \brief Largest difference in depth of neighbouring points; f(p). */
  double depthStep(double z) const { return depth_change * z + depth_change_offset; }
};

/** \brief A node of the graph: a block, or the blocks that merged into it. */
struct Segment {
  PlanePatch patch;
  std::vector<int> neighbours; ///< nodes, each once, in rising order
};

/** \brief Blocks and segments as nodes with links between them. */
struct Graph {
  BlockGrid grid;
  std::vector<Segment> nodes;  ///< node k < grid.size(): block k
  std::vector<bool> is_in_use; ///< of each node; those that were rejected are not
};

/** \brief The graph of the blocks; algorithm 2, InitGraph, but that not every block is
 * the middle of a triple that is tested for a crease: see ChainOfBlocks. */
Graph makeGraph(const Cloud& cloud, const Parameters& parameters);

/** \brief What clustering found. */
struct Clusters {
  std::vector<int> planes; ///< nodes, most points first
  std::vector<int> parent; ///< of each node: what it merged into, itself: nothing

  /** \brief The node at the top of a node's tree. */
  int root(int node) const;
};

/** \brief Merge the nodes; algorithm 3, AHCluster. New nodes are added at the end. */
Clusters cluster(Graph& graph, const Parameters& parameters);

/** \brief Labels of the points; algorithm 4, Refine. */
Labels refine(const Cloud& cloud, const Graph& graph, const Clusters& clusters,
              const Parameters& parameters);

} // namespace pcl_mrf_planes::benchmarks::peac
