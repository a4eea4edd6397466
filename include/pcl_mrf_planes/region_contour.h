// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief 4-connected parts of the labels of an image. */
struct PCL_MRF_PLANES_EXPORT ConnectedParts {
  static constexpr int NONE = -1;   ///< of points of no part
  std::vector<int> part_of_point;   ///< part of every point, NONE where the label is 0
  std::vector<int> size;            ///< points of each part
  std::vector<int> first;           ///< first point of each part, row by row
  std::vector<std::uint16_t> label; ///< label of each part, 1 or more
};

/** \brief Find the connected parts of a label image; label 0 is background.
 * O(width * height) */
PCL_MRF_PLANES_EXPORT ConnectedParts
findConnectedParts(const std::vector<std::uint16_t>& labels, int width, int height);

/** \brief Outer boundary of a connected part: its points in the order in which one
 * walks around it, clockwise in the image, each step to an 8-neighbour; the first point
 * is not repeated at the end.
 *
 * Moore's tracing, ended when the walk would leave the first point as it did before
 * (Jacob's criterion), so that narrow parts that are passed twice do not cut it short.
 *
 * \param[in] parts result of findConnectedParts()
 * \param[in] part which one
 * \param[in] width, height of the image, points
 * \return indices of points; one for a part of one point. O(length)
 */
PCL_MRF_PLANES_EXPORT std::vector<int> traceContour(const ConnectedParts& parts,
                                                    int part, int width, int height);

} // namespace pcl_mrf_planes
