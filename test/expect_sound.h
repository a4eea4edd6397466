// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace pcl_mrf_planes {

/// What holds for any input.
inline void expectSound(const OrganizedPoints& points, const PlaneSegmentation& result)
{
  ASSERT_EQ(result.labels.size(), points.size());
  std::vector<std::size_t> count(result.regions.size() + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_LE(result.labels[i], result.regions.size()) << "point " << i;
    if (points.valid[i] == 0) {
      ASSERT_EQ(result.labels[i], 0) << "invalid point " << i;
    }
    ++count[result.labels[i]];
  }
  for (std::size_t k = 0; k < result.regions.size(); ++k) {
    const PlaneRegion& region = result.regions[k];
    EXPECT_EQ(region.indices.size(), count[k + 1]) << "plane " << k;
    EXPECT_FALSE(region.indices.empty()) << "plane " << k;
    EXPECT_NEAR(region.plane.normal.norm(), 1.0, 1e-6) << "plane " << k;
    EXPECT_GE(region.plane.d, 0.0) << "plane " << k;
    EXPECT_TRUE(region.centroid.allFinite() && region.covariance.allFinite());
    EXPECT_TRUE(region.area >= 0.0 && region.rms >= 0.0) << "plane " << k;
  }
}

} // namespace pcl_mrf_planes
