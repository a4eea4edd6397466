// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/noise_estimation.h"
#include "frame_memory.h"

namespace pcl_mrf_planes::adaptive {

/** \brief Planes and the sums of their points. */
struct FittedRegions {
  FrameVector<TileSums> sums;
  FrameVector<FittedPlane> planes;

  void reserve(std::size_t count)
  {
    planes.reserve(count);
    sums.reserve(count);
  }

  void add(const FittedPlane& plane, const TileSums& sum)
  {
    planes.push_back(plane);
    sums.push_back(sum);
  }
};

/** \brief Planes found, and which plane each smallest tile belongs to (-1: none). */
struct TileRegions : FittedRegions {
  FrameVector<int> cell_region; ///< per tile of level 0
};

/** \brief Variance that a plane of the given fit is allowed: noise and flatness [m^2]. */
double allowedVariance(const FittedPlane& plane, const NoiseLaw& noise,
                       const AdaptiveParameters& p);

/** \brief Whether so many points, at least \a least, fit their plane as well as the noise
 * allows. */
bool isPlane(const FittedPlane& plane, double least, const NoiseLaw& noise,
             const AdaptiveParameters& p);

/** \brief Largest tiles that one plane fits: from the top of the pyramid, split where
 * the residual exceeds the noise of that extent. */
TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, unsigned int threads = 1);

/** \brief Agglomerative merging of touching regions on pooled sums, the most alike first,
 * while the deviation of the smaller part stays within the noise. O(n log n). */
TileRegions mergeTouching(TileRegions tiles, const std::vector<TileLevel>& pyramid,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          unsigned int threads = 1);

/** \brief Join coplanar parts with no view behind the plane between them: what separates
 * them stands in front, so the surface may well go on behind it. */
TileRegions joinCoplanar(TileRegions parts, const OrganizedPoints& points,
                         const TileLevel& cells, const NoiseLaw& noise,
                         const AdaptiveParameters& parameters,
                         unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
