// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tile_cells.h"
#include "view_frame.h"

#include "colour_track.h"

#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief One picture of the film: the algorithm after one of its steps. */
struct FilmStep {
  std::string title;
  std::string note;
  std::vector<std::uint16_t> labels;  ///< per point: 0 none
  std::vector<std::uint32_t> classes; ///< colour of each label from 1
  int iteration = -1;                 ///< of belief propagation; -1: none
};

/** \brief A segmentation step by step. */
struct AlgorithmFilm {
  std::vector<FilmStep> steps;
  std::vector<double> energy; ///< after 0, 1, 2, ... iterations
};

/** \brief Detected tiles, merged planes, then the labels after each recorded stage.
 * \param[in] track of the result's planes: a plane has its colour in all steps */
AlgorithmFilm filmOf(const SegmentationStages& stages, const TileCells& cells,
                     const apps::ColourTrack& track);

} // namespace pcl_mrf_planes::viewer
