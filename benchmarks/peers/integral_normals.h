// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

namespace pcl_mrf_planes::benchmarks {

/** \brief Normals by pcl::IntegralImageNormalEstimation, covariance method, NaN where
 * there is none.
 * \param[in] values "smoothing": window, points; "depth_change": share of the depth
 *            over which the window does not reach
 */
pcl::PointCloud<pcl::Normal>::Ptr integralNormals(const Cloud::ConstPtr& cloud,
                                                  const Values& values);

} // namespace pcl_mrf_planes::benchmarks
