// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane.h>
#include <pcl_mrf_planes/plane_field.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Where in a segmentation labels stand. */
enum class Stage {
  MERGED,    ///< after merging: every tile has the label of the plane that it went to
  JOINED,    ///< coplanar parts behind an occluder share a label (Method::ADAPTIVE)
  CELLS,     ///< after a round of labelling cells of 4x4 points (Method::ADAPTIVE)
  ITERATION, ///< after so many iterations, or passes, of belief propagation
  REFINED,   ///< planes fitted again, small parts dropped (Method::ADAPTIVE)
  FINAL      ///< the result
};

/** \brief The stage in a word: "merged", "joined", "cells", "iteration", ... */
PCL_MRF_PLANES_EXPORT std::string stageName(Stage stage);

/** \brief A tile that was looked at and what became of it. */
struct PCL_MRF_PLANES_EXPORT StageTile {
  static constexpr int NONE = -1; ///< of tiles that went to no plane
  int x = 0;                      ///< column of the first point
  int y = 0;                      ///< row of the first point
  int width = 0;     ///< columns of points, those outside of the image left out
  int height = 0;    ///< rows of points
  bool kept = false; ///< a plane fits it
  Plane plane;       ///< sensor frame; of tiles that are kept
  double rms = 0.0;  ///< fit error: root mean square distance, metres
  int merged = NONE; ///< index among SegmentationStages::merged_planes, or NONE
};

/** \brief The labels as they stand after a stage. */
struct PCL_MRF_PLANES_EXPORT StageLabels {
  Stage stage = Stage::FINAL;        ///< after which one
  int count = 0;                     ///< iterations, passes or rounds done, from 0
  std::vector<std::uint16_t> labels; ///< per point: 0 no plane, k planes[k - 1]
  std::vector<Plane> planes;         ///< sensor frame
  /// Of the random field, for Stage::ITERATION. Method::PAPER: equation (6).
  /// Method::ADAPTIVE: sigmas, over the blocks of points that are not settled beforehand.
  std::optional<FieldEnergy> energy;
};

/** \brief How a segmentation came about, to be looked at and taught. */
struct PCL_MRF_PLANES_EXPORT SegmentationStages {
  int width = 0;  ///< columns of all images of labels
  int height = 0; ///< rows of all images of labels
  /// Method::PAPER: all of the grid. Method::ADAPTIVE: those chosen, the largest first.
  std::vector<StageTile> tiles;
  std::vector<Plane> merged_planes; ///< sensor frame
  std::vector<StageLabels> labels;  ///< in order; the last one is Stage::FINAL
  PlaneSegmentation result;         ///< what segmentPlanes() gives, bit for bit
};

/** \brief Segment and record every stage on the way.
 *
 * The inference is repeated with 0, 1, 2, ... iterations, so this takes as long as some
 * segmentations, and in Method::PAPER memory of 10 bytes a point and label. With
 * AdaptiveParameters::sampling, labels before the result are those of the samples, each
 * for all points that follow it.
 *
 * \param[in] points the cloud in the sensor frame
 * \param[in] parameters must pass Parameters::validate()
 */
PCL_MRF_PLANES_EXPORT SegmentationStages recordStages(const OrganizedPoints& points,
                                                      const Parameters& parameters);

} // namespace pcl_mrf_planes
