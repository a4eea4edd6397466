// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/region_refinement.h"
#include "frame_memory.h"

#include <pcl_mrf_planes/organized_points.h>

#include <boost/container/flat_map.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/** \brief Where two regions meet. */
struct Border {
  int length = 0; ///< points
  double step =
      0; ///< sum of squared distances across, the smaller one of both ways, m^2
};

/** \brief Borders of regions with each other, and with points on no plane. */
struct RegionBorders {
  /// By the regions on either side, the smaller number first.
  boost::container::flat_map<std::pair<int, int>, Border, std::less<>,
                             FrameAllocator<std::pair<std::pair<int, int>, Border>>>
      between;
  /// Border points of each region beyond which the surface is on no plane, looking right
  /// and down.
  FrameVector<int> open;
  /// Those of them beyond which it goes on in a shallow crease.
  FrameVector<int> goes_on;

  RegionBorders& operator+=(const RegionBorders& other);
};

/** \brief Looks across every change of label, at points so far apart that the smoothing of
 * edges by the sensor does not count. O(points)
 * \param[in] sharpest_crease [rad] that is shallow */
RegionBorders findBorders(const OrganizedPoints& points, const FittedRegions& regions,
                          const LabelledPoints& image, double sharpest_crease,
                          unsigned int threads = 1);

} // namespace pcl_mrf_planes::adaptive
