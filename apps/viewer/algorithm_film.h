// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tile_cells.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief One picture of the film: the algorithm after one of its steps. */
struct FilmStep {
  std::string title;
  std::vector<std::uint16_t> labels; ///< per point: 0 none, k a tile's or label plane's
  std::string note;
  int iteration = -1; ///< of belief propagation; -1: before it
};

/** \brief The paper's method step by step on one frame. */
struct AlgorithmFilm {
  std::vector<FilmStep> steps;
  std::vector<double> energy; ///< after 0, 1, 2, ... iterations, equation (6)
};

/** \brief Run the paper's method and keep every step: detected tiles, merged planes, labels
 * after 0, 1, ... iterations. The labels are those of segmentAsInPaper() bit for bit.
 *
 * Memory: 10 L bytes a point while it runs, 2 bytes a point and step after it.
 * \param[in] most_iterations bound of the film's length */
AlgorithmFilm filmAlgorithm(const ViewFrame& frame, const Parameters& parameters,
                            int most_iterations = 30);

} // namespace pcl_mrf_planes::viewer
