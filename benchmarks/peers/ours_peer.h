// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

#include <pcl_mrf_planes/parameters.h>

namespace pcl_mrf_planes::benchmarks {

/** \brief Labels by the class for PCL, on one thread.
 * \param[out] milliseconds see Peer::segment */
Labels segmentByClass(const Cloud::ConstPtr& cloud, const Parameters& parameters,
                      double& milliseconds);

} // namespace pcl_mrf_planes::benchmarks
