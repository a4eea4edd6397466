// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"

namespace pcl_mrf_planes::viewer {

/** \brief The same frame by pcl::IntegralImageNormalEstimation and
 * pcl::OrganizedMultiPlaneSegmentation, with the values of PCL's own tutorial. */
SegmentedView segmentByPcl(const ViewFrame& frame);

} // namespace pcl_mrf_planes::viewer
