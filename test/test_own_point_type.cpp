// SPDX-License-Identifier: BSD-3-Clause
//
// A point type that PCL does not know: the templates are compiled here.
#define PCL_NO_PRECOMPILE
#include "reference/clouds.h"
#include "reference/inputs.h"

#include <pcl/impl/pcl_base.hpp>
#include <pcl/register_point_struct.h>

#include <gtest/gtest.h>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic" // PCL's macro has structs without names
struct EIGEN_ALIGN16 OwnPoint {
  PCL_ADD_POINT4D
  double time;
  std::uint16_t ring;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
#pragma GCC diagnostic pop

namespace pcl_mrf_planes {
namespace {

TEST(OwnPointTypeTest, SegmentsAsPlainPointsDo)
{
  const auto frame =
      reference::takePicture("corner", 96, 72, 1, scenes::SensorNoise::kinect());
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> plain;
  pcl::MRFPlaneSegmentation<OwnPoint> own;
  plain.setTileSize(12, 12);
  own.setTileSize(12, 12);
  plain.setInputCloud(reference::toCloud<pcl::PointXYZ>(frame));
  own.setInputCloud(reference::toCloud<OwnPoint>(frame));
  reference::Output<pcl::PointXYZ> expected;
  reference::Output<OwnPoint> output;
  expected.run(plain);
  output.run(own);
  EXPECT_GE(output.models.size(), 2U) << "a corner has planes in it";
  EXPECT_EQ(output.labelValues(), expected.labelValues());
  pcl::MRFPlaneSegmentation<OwnPoint>::PlanarRegions regions;
  own.segment(regions);
  ASSERT_EQ(regions.size(), output.models.size());
  EXPECT_FALSE(regions.front().getContour().empty());
}

} // namespace
} // namespace pcl_mrf_planes
