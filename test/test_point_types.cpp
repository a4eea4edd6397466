// SPDX-License-Identifier: BSD-3-Clause
//
// The class as the library compiled it, for every XYZ point type of PCL.
#include "reference/clouds.h"
#include "reference/inputs.h"

#include <pcl/impl/instantiate.hpp>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

namespace pcl_mrf_planes {
namespace {

template <typename PointT>
class PointTypeTest : public testing::Test {};

using PointTypes = testing::Types<BOOST_PP_SEQ_ENUM(PCL_XYZ_POINT_TYPES)>;
TYPED_TEST_SUITE(PointTypeTest, PointTypes, ); // clang++ wants the third argument

TYPED_TEST(PointTypeTest, GivesTheLabelsOfPlainPoints)
{
  const auto frame =
      reference::takePicture("corner", 96, 72, 1, scenes::SensorNoise::kinect());
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> plain;
  pcl::MRFPlaneSegmentation<TypeParam> typed;
  plain.setTileSize(12, 12);
  typed.setTileSize(12, 12);
  plain.setInputCloud(reference::toCloud<pcl::PointXYZ>(frame));
  typed.setInputCloud(reference::toCloud<TypeParam>(frame));
  reference::Output<pcl::PointXYZ> expected;
  reference::Output<TypeParam> output;
  expected.run(plain);
  output.run(typed);
  EXPECT_GE(output.models.size(), 2U) << "a corner has planes in it";
  EXPECT_EQ(output.labelValues(), expected.labelValues())
      << "fields beside x, y, z must not matter";
  typename pcl::MRFPlaneSegmentation<TypeParam>::PlanarRegions regions;
  typed.segment(regions);
  EXPECT_EQ(regions.size(), output.models.size());
}

} // namespace
} // namespace pcl_mrf_planes
