// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace pcl_mrf_planes {

/// A plane and two axes in it, and the noise of points along its normal.
struct PlaneFrame {
  double normal[3], d; ///< distance of a point: n . p + d
  double right[3], u0; ///< u = right . p - u0
  double up[3], v0;    ///< v = up . p - v0
  double of_squared;   ///< variance over the squared distance of the point
  double of_range;     ///< added to it over the squared range of the point
};

/// Sums over points of a plane: r its distance, w its variance.
struct FrameSums {
  enum Sum { U, V, R, W, WU, WV, WUU, WUV, WVV, COUNT };
  double sum[COUNT] = {};
};

/// Adds up neighbouring points. \param[in] variance of each point, instead of what its
/// distance says; or null
/// The same bits for every instruction set: eight points are added up apart. O(count)
FrameSums sumInFrame(const PlaneFrame& frame, const float* x, const float* y,
                     const float* z, const double* variance, std::size_t count);

} // namespace pcl_mrf_planes
