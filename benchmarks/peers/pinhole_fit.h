// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

namespace pcl_mrf_planes::benchmarks {

/** \brief Column = fx x/z + cx, row = fy y/z + cy. */
struct PinholeFit {
  double fx = 1.0, fy = 1.0, cx = 0.0, cy = 0.0; ///< points
};

/** \brief The pinhole that fits an organized cloud best, least squares, for methods
 * that ask for a camera. A sensor that is none gets the nearest one. */
PinholeFit fitPinhole(const Cloud& cloud);

} // namespace pcl_mrf_planes::benchmarks
