// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/plane.h>
#include <pcl_mrf_planes/tile_plane_detection.h>

#include <vector>

namespace pcl_mrf_planes {

/** \brief A plane model as the merging sees it. */
struct PCL_MRF_PLANES_EXPORT PlaneModel {
  Plane plane;         ///< turned towards the sensor
  double error = 0.0;  ///< rms distance of the tile that the plane comes from, metres
  double points = 0.0; ///< valid points of all the tiles that refer to it
};

/** \brief The L label planes and which of them each plane refers to. */
struct PCL_MRF_PLANES_EXPORT PlaneClusters {
  static constexpr int NONE = -1; ///< in assignment: refers to no plane
  /// Best supported first; ties by error, then by coefficients.
  std::vector<PlaneModel> planes;
  /// For every input plane its index in planes, or NONE.
  std::vector<int> assignment;
};

/** \brief Merge redundant planes, section IV-B, equation (5).
 *
 * Projects the coefficients onto the a, b, c and d axes in turn, walks along each axis
 * and merges neighbours whose dissimilarity is below \a threshold: the plane with the
 * smaller error keeps its coefficients, the other one's data refers to it. Passes
 * repeat until nothing merges. Pairs that were never neighbours on an axis are then
 * closed, best plane first, so that every two remaining planes are at least \a
 * threshold apart, on which equation (9) relies.
 *
 * The result depends on the set of planes, not on their order. O(P log P) a pass and
 * O(P L) for the closing, for P planes in and L out.
 *
 * \param[in] models planes turned towards the sensor, see Plane::orientTowardsOrigin()
 * \param[in] beta weight of |d_i - d_j|, 1/m
 * \param[in] threshold v of equation (5)
 */
PCL_MRF_PLANES_EXPORT PlaneClusters mergePlanes(const std::vector<PlaneModel>& models,
                                                double beta, double threshold);

/** \brief mergePlanes() over the kept tiles of an image of planar fits.
 *
 * Keeps at most parameters.max_planes label planes, the best supported; the assignment
 * is the tile-to-plane map, a coarse segmentation of its own.
 */
PCL_MRF_PLANES_EXPORT PlaneClusters clusterTilePlanes(const TileImage& image,
                                                      const Parameters& parameters);

} // namespace pcl_mrf_planes
