// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"
#include "frame_memory.h"
#include "label_runs.h"

namespace pcl_mrf_planes::adaptive {

/** \brief The label image, 0 for none, point by point and by the runs of its labels. */
struct LabelledPoints {
  std::vector<std::uint16_t> labels;
  LabelRuns runs;

  explicit LabelledPoints(std::vector<std::uint16_t> of_points, int width,
                          unsigned int threads = 1)
  : labels(std::move(of_points))
  , runs(findRuns(labels, width, 0, threads))
  {}

  /** \brief Give every label its new number, id[label]; 0 takes it away. */
  void renumber(const FrameVector<std::uint16_t>& id, unsigned int threads = 1);
};

/** \brief After labelling: small components of a label lose it, planes are fitted again
 * to their points, those that are not planar given the noise or too small are dropped. Of
 * points that would keep a label from being a plane, one in a hundred may be left out.
 * Labels are renumbered 1..planes.size().
 * \param[in] before the planes that the labels had, from label 1 on */
FittedRegions refineRegions(const OrganizedPoints& points,
                            const std::vector<TileLevel>& pyramid,
                            const FittedRegions& before, const NoiseLaw& noise,
                            const AdaptiveParameters& parameters, LabelledPoints& image,
                            unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
