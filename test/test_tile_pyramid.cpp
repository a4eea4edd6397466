// SPDX-License-Identifier: BSD-3-Clause
//
// The tiles of the adaptive method against sums by the book.
#include "adaptive/tile_pyramid.h"
#include "reference/inputs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl_mrf_planes::adaptive {
namespace {

TEST(TilePyramidTest, InvalidPointsAreInNoTileNotEvenInOneThatTheBorderCuts)
{
  scenes::Random random(8);
  for (const int width : {3, 16, 17, 18, 35})
    for (const int height : {1, 8, 13}) {
      const OrganizedPoints points =
          reference::randomPoints(random, width, height, 0.6);
      const auto pyramid = buildTilePyramid(points, AdaptiveParameters());
      for (const TileLevel& level : pyramid)
        for (int r = 0; r < level.rows; ++r)
          for (int c = 0; c < level.columns; ++c) {
            int valid = 0;
            for (int v = r * level.side; v < std::min(height, (r + 1) * level.side);
                 ++v)
              for (int u = c * level.side; u < std::min(width, (c + 1) * level.side);
                   ++u)
                valid += points.valid[static_cast<std::size_t>(v * width + u)];
            EXPECT_EQ(level.sums[level.at(c, r)].n, valid)
                << "tile " << c << ", " << r << " of side " << level.side << " in "
                << width << " x " << height;
          }
    }
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
