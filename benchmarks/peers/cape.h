// SPDX-License-Identifier: BSD-3-Clause
/** \file Planes by growing cells, after Proenca and Gao, "Fast cylinder and plane
 * extraction from depth cameras for visual odometry", IROS 2018 (known as CAPE): our own
 * implementation, of planes only, of what the paper describes, not the authors' program.
 */
#pragma once

#include "block_grid.h"
#include "plane_patch.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::benchmarks::cape {

/** \brief Lengths in metres, angles in degrees. The defaults are the published ones. */
struct Parameters {
  int cell_side = 20;              ///< points
  double depth_sigma = 0.001425;   ///< of the standard deviation of depth, 1/m
  double cell_tolerance = 0.01;    ///< added to depth_sigma z^2
  double depth_step = 0.1;         ///< between neighbouring points of a cell
  double angle = 15.0;             ///< between cells that grow, segments that merge
  double least_distance = 0.02;    ///< bounds of what a cell may be off the plane
  double most_distance = 0.05;     ///< of the cell that it is reached from
  double merge_distance = 0.00707; ///< between segments that merge
  int histogram_bins = 20;         ///< of each of the two angles of a normal
  int min_seeds = 5;               ///< cells in the fullest bin for another segment
  int min_cells = 4;               ///< of a segment
  double min_flatness = 100.0;     ///< of a segment: variance across over that along
};

/** \brief A cell of the image, points that one plane fits or none. */
struct Cell {
  PlanePatch patch;
  double reach = 0.0; ///< largest distance from the plane of a cell beside it, m
  bool is_planar = false;
};

/** \brief Fit the cells. */
std::vector<Cell> fitCells(const Cloud& cloud, const BlockGrid& grid,
                           const Parameters& parameters);

/** \brief Cells by the direction of their normals, in spherical coordinates. */
class NormalHistogram {
public:
  NormalHistogram(const std::vector<Cell>& cells, int bins);

  /** \brief Cells of the fullest bin, in the order of the grid. */
  std::vector<int> fullestBin() const;

  void remove(int cell);

private:
  std::vector<int> bin_;   // of each cell, -1: it is not in any
  std::vector<int> count_; // of each bin
};

/** \brief Cells that belong to one plane. */
struct Segment {
  PlanePatch patch;
  std::vector<int> cells;
};

/** \brief Segments grown from the flattest cells of the commonest directions. */
std::vector<Segment> growSegments(const std::vector<Cell>& cells, const BlockGrid& grid,
                                  const Parameters& parameters);

/** \brief Merge neighbouring segments of one plane. */
std::vector<Segment> mergeSegments(const std::vector<Segment>& segments,
                                   const BlockGrid& grid, const Parameters& parameters);

/** \brief Labels of the points: inner cells as a whole, others point by point. */
Labels refine(const Cloud& cloud, const std::vector<Segment>& segments,
              const BlockGrid& grid);

} // namespace pcl_mrf_planes::benchmarks::cape
