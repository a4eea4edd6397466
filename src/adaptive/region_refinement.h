// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"
#include "frame_memory.h"
#include "label_runs.h"

namespace pcl_mrf_planes::adaptive {

/** \brief The label image, 0 for none, point by point and by the runs of its labels. Runs are
 * few: when labels get new numbers, only they do, and points keep the name that they had. */
class LabelledPoints {
public:
  std::vector<std::uint16_t> labels; ///< 0, or the names
  LabelRuns runs;                    ///< of the numbers

  explicit LabelledPoints(std::vector<std::uint16_t> of_points, int width,
                          unsigned int threads = 1);

  /** \brief The number of the label of a point. */
  std::uint16_t at(std::size_t i) const { return number_[labels[i]]; }

  /** \brief Give every label its new number, id[label]; 0 takes it away. */
  void renumber(const FrameVector<std::uint16_t>& id, unsigned int threads = 1);

  /** \brief Make the numbers the names. */
  void write(unsigned int threads = 1);

private:
  FrameVector<std::uint16_t> number_; ///< by name
};

/** \brief After labelling: small components of a label lose it, planes are fitted again
 * to their points, those that are not planar given the noise or too small are dropped. Of
 * points that would keep a label from being a plane, one in a hundred may be left out.
 * Labels are numbered 1..planes.size() then.
 * \param[in] before the planes that the labels had, from label 1 on */
FittedRegions refineRegions(const OrganizedPoints& points,
                            const std::vector<TileLevel>& pyramid,
                            const FittedRegions& before, const NoiseLaw& noise,
                            const AdaptiveParameters& parameters, LabelledPoints& image,
                            unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
