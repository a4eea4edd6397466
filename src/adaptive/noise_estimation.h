// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "adaptive/tile_pyramid.h"

#include <pcl_mrf_planes/noise_model.h>

#include <boost/container/static_vector.hpp>

namespace pcl_mrf_planes::adaptive {

/** \brief Noise of a plane as a function of distance and extent.
 *
 * sigma(z) = a + c z^2 is the RMS distance of the points of a tile of 2 cells from the
 * tile's own plane; growth[l] multiplies it for tiles of level l, and region for planes
 * of any size. White noise grows by 1; a Kinect's, correlated over tens of pixels, by 2. */
struct NoiseLaw {
  double a = 0;
  double b = 0; ///< of a stated sigma only
  double c = 0;
  double floor = 0; ///< [m at 1 m]
  boost::container::static_vector<double, MOST_LEVELS> growth;
  double region = 1;

  double small(double z) const
  {
    const double s = a + z * (b + z * c);
    const double f = floor * (z > 0.1 ? z : 0.1);
    return s > f ? s : f;
  }
  /** \brief growth of sigma for a plane of n points, between the tiles' and the region's. */
  double growthOf(double n) const;
};

/** \brief Share of the noise variance that lies along the normal. Noise along the ray
 * would give cos^2; on Kinect data and laser scans about cos was seen. */
inline double incidenceFactor(const FittedPlane& plane)
{
  return std::max(plane.incidence(), 0.02);
}

/** \brief Estimate the noise from the tiles themselves, robust to tiles on edges. */
NoiseLaw estimateNoise(const std::vector<TileLevel>& pyramid,
                       const AdaptiveParameters& parameters, unsigned int threads = 1);

/** \brief The noise of a sensor that the user names: the same for planes of all sizes. */
NoiseLaw statedNoise(const NoiseModel& stated, const std::vector<TileLevel>& pyramid,
                     const AdaptiveParameters& parameters);

/** \brief Fill in TileSums::noise (and FittedPlane::noise) of all tiles: the model's variance,
 * raised where the tiles around all show more (materials, incidence). */
void assignLocalNoise(std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                      const AdaptiveParameters& parameters, unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
