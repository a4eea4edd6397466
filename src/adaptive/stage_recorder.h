// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/segmentation_stages.h>

namespace pcl_mrf_planes::adaptive {

/** \brief recordStages() of Method::ADAPTIVE. */
SegmentationStages recordAdaptive(const OrganizedPoints& points,
                                  const Parameters& parameters);

} // namespace pcl_mrf_planes::adaptive
