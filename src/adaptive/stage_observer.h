// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"
#include "adaptive/region_refinement.h"

#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/segmentation_stages.h>

namespace pcl_mrf_planes::adaptive {

/** \brief Is shown what the stages leave, as they leave it, and changes nothing. */
class StageObserver {
public:
  virtual ~StageObserver() = default;

  virtual void seeTiles(const TileRegions& tiles, const TileLevel& cells) = 0;
  /// After Stage::MERGED, JOINED and every round of CELLS.
  virtual void seeRegions(Stage stage, const TileRegions& regions,
                          const TileLevel& cells) = 0;
  virtual void seeField(const CandidateField& field, const OrganizedPoints& points,
                        const AdaptiveParameters& parameters) = 0;
  virtual void seeImage(Stage stage, const FittedRegions& regions,
                        const LabelledPoints& image) = 0;
};

struct Workspace;

/** \brief segmentAdaptively() before the eyes of an observer, if it is not null.
 * \param[in,out] result is replaced; the memory of the one before is used again */
void segmentObserved(const OrganizedPoints& points, const Parameters& parameters,
                     StageObserver* observer, Workspace& workspace,
                     PlaneSegmentation& result);

} // namespace pcl_mrf_planes::adaptive
