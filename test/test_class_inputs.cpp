// SPDX-License-Identifier: BSD-3-Clause
//
// pcl::MRFPlaneSegmentation: regions of interest, and inputs that cannot be segmented.
#include "reference/clouds.h"
#include "reference/inputs.h"

#include <pcl/console/print.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

namespace pcl_mrf_planes {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;
using Output = reference::Output<pcl::PointXYZ>;

Cloud::Ptr roomCloud()
{
  static const auto frame =
      reference::takePicture("room", 160, 120, 4, scenes::SensorNoise::kinect());
  return reference::toCloud<pcl::PointXYZ>(frame);
}

Output segmentWith(const std::function<void(Segmentation&)>& prepare,
                   const Cloud::ConstPtr& cloud)
{
  Segmentation segmentation;
  segmentation.setTileSize(10, 10);
  segmentation.setInputCloud(cloud);
  prepare(segmentation);
  Output output;
  output.run(segmentation);
  return output;
}

/// A window of the room and what must come out of it: the same as when everything
/// outside it was never measured.
class RegionOfInterestTest : public testing::Test {
protected:
  static constexpr int LEFT = 31, TOP = 22, WIDTH = 77, HEIGHT = 66;

  RegionOfInterestTest()
  {
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 160; ++x) {
        const bool inside =
            x >= LEFT && x < LEFT + WIDTH && y >= TOP && y < TOP + HEIGHT;
        const int i = y * 160 + x;
        if (inside)
          indices_.push_back(i);
        else
          masked_->points[static_cast<std::size_t>(i)].x = reference::NOT_MEASURED;
      }
    expected_ = segmentWith([](Segmentation&) {}, masked_);
  }

  void expectWindow(const Output& output) const
  {
    EXPECT_GE(output.models.size(), 2U) << "the window shows some planes";
    EXPECT_EQ(output.labelValues(), expected_.labelValues())
        << "points outside the region of interest took part";
    ASSERT_EQ(output.models.size(), expected_.models.size());
    for (std::size_t k = 0; k < output.models.size(); ++k)
      EXPECT_EQ(output.models[k].values, expected_.models[k].values)
          << "points outside the region of interest moved plane " << k;
    for (std::size_t i = 0; i < output.labels.size(); ++i)
      if (!std::binary_search(indices_.begin(), indices_.end(), static_cast<int>(i))) {
        EXPECT_EQ(output.labels[i].label, 0U) << "a point outside got a label";
      }
  }

  Cloud::Ptr cloud_ = roomCloud();
  Cloud::Ptr masked_ = roomCloud();
  pcl::Indices indices_;
  Output expected_;
};

TEST_F(RegionOfInterestTest, BySharedIndices)
{
  expectWindow(segmentWith(
      [&](Segmentation& s) {
        s.setIndices(pcl::IndicesPtr(new pcl::Indices(indices_)));
      },
      cloud_));
}

TEST_F(RegionOfInterestTest, BySharedConstIndices)
{
  expectWindow(segmentWith(
      [&](Segmentation& s) {
        s.setIndices(pcl::IndicesConstPtr(new pcl::Indices(indices_)));
      },
      cloud_));
}

TEST_F(RegionOfInterestTest, ByPointIndices)
{
  pcl::PointIndices::Ptr indices(new pcl::PointIndices);
  indices->indices = indices_;
  expectWindow(segmentWith(
      [&](Segmentation& s) { s.setIndices(pcl::PointIndicesConstPtr(indices)); },
      cloud_));
}

TEST_F(RegionOfInterestTest, ByWindow)
{
  expectWindow(segmentWith(
      [&](Segmentation& s) { s.setIndices(TOP, LEFT, HEIGHT, WIDTH); }, cloud_));
}

TEST_F(RegionOfInterestTest, OrderAndDuplicatesDoNotMatter)
{
  pcl::Indices shuffled(indices_.rbegin(), indices_.rend());
  shuffled.insert(shuffled.end(), indices_.begin(), indices_.begin() + 100);
  expectWindow(segmentWith(
      [&](Segmentation& s) {
        s.setIndices(pcl::IndicesPtr(new pcl::Indices(shuffled)));
      },
      cloud_));
}

TEST_F(RegionOfInterestTest, AllIndicesAreNoIndices)
{
  pcl::IndicesPtr all(new pcl::Indices);
  for (int i = 0; i < 160 * 120; ++i)
    all->push_back(i);
  const Output with = segmentWith([&](Segmentation& s) { s.setIndices(all); }, cloud_);
  const Output without = segmentWith([](Segmentation&) {}, cloud_);
  EXPECT_EQ(with.labelValues(), without.labelValues());
}

struct BadInput {
  std::string name;
  std::function<void(Segmentation&)> prepare;
};

void PrintTo(const BadInput& input, std::ostream* out)
{
  *out << input.name;
}

BadInput badValue(const std::string& name,
                  const std::function<void(Segmentation&)>& set)
{
  return {name, [set](Segmentation& s) {
            s.setInputCloud(roomCloud());
            set(s);
          }};
}

BadInput badCloud(const std::string& name, const std::function<void(Cloud&)>& change)
{
  return {name, [change](Segmentation& s) {
            const Cloud::Ptr cloud = roomCloud();
            change(*cloud);
            s.setInputCloud(cloud);
          }};
}

std::vector<BadInput> badInputs()
{
  constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();
  const auto indices = [](int index) {
    return [index](Segmentation& s) {
      s.setIndices(pcl::IndicesPtr(new pcl::Indices({1, 2, index})));
    };
  };
  return {
      {"NoCloud", [](Segmentation& s) { s.setInputCloud(nullptr); }},
      badCloud("Empty", [](Cloud& cloud) { cloud.clear(); }),
      badCloud("Unorganized",
               [](Cloud& cloud) {
                 cloud.width = static_cast<std::uint32_t>(cloud.size());
                 cloud.height = 1;
               }),
      badCloud("WrongSize", [](Cloud& cloud) { cloud.width = 161; }),
      badCloud("WrappedSize", [](Cloud& cloud) { cloud.height = 120U + (1U << 27U); }),
      badCloud("AllNaN",
               [](Cloud& cloud) {
                 for (auto& p : cloud)
                   p.x = p.y = p.z = reference::NOT_MEASURED;
               }),
      badCloud("OneColumn",
               [](Cloud& cloud) {
                 cloud.height = static_cast<std::uint32_t>(cloud.size());
                 cloud.width = 1;
                 for (std::size_t i = 0; i < cloud.size(); ++i) { // rays of one column
                   const float depth = 2.0f + 0.5f * static_cast<float>(i % 7);
                   const float slope = 1e-4f * static_cast<float>(i);
                   cloud[i].getVector3fMap() << 0.3f * depth, slope * depth, depth;
                 }
               }),
      badValue("IndexBehindTheEnd", indices(160 * 120)),
      badValue("NegativeIndex", indices(-1)),
      badValue("TileSize", [](Segmentation& s) { s.setTileSize(0, 40); }),
      badValue("Lambda", [](Segmentation& s) { s.setLambda(NAN_VALUE); }),
      badValue("Tau", [](Segmentation& s) { s.setTau(-1.0); }),
      badValue("Iterations", [](Segmentation& s) { s.setIterations(-1); }),
      badValue("Noise",
               [](Segmentation& s) {
                 s.setNoiseModel({0, 0, NAN_VALUE});
               }),
  };
}

class BadInputTest : public testing::TestWithParam<BadInput> {};

INSTANTIATE_TEST_SUITE_P(All, BadInputTest, testing::ValuesIn(badInputs()),
                         [](const auto& param) { return param.param.name; });

TEST_P(BadInputTest, LeavesNoPlanesAndOldContentsAreCleared)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Segmentation segmentation;
  segmentation.setTileSize(10, 10);
  segmentation.setInputCloud(roomCloud());
  Output output;
  Segmentation::PlanarRegions regions;
  std::vector<pcl::PointIndices> boundaries;
  Segmentation::PointCloudLPtr labels;
  output.run(segmentation);
  segmentation.segment(regions);
  ASSERT_FALSE(output.empty());
  ASSERT_FALSE(regions.empty());

  GetParam().prepare(segmentation);
  EXPECT_NO_THROW(output.run(segmentation));
  EXPECT_TRUE(output.models.empty()) << "planes of the run before are still there";
  EXPECT_TRUE(output.inliers.empty()) << "inliers of the run before are still there";
  EXPECT_TRUE(output.centroids.empty());
  EXPECT_TRUE(output.covariances.empty());
  for (const pcl::Label& label : output.labels)
    ASSERT_EQ(label.label, 0U) << "labels of the run before are still there";
  EXPECT_NO_THROW(segmentation.segment(regions));
  EXPECT_TRUE(regions.empty()) << "regions of the run before are still there";
  EXPECT_NO_THROW(segmentation.segmentAndRefine(regions, output.models, output.inliers,
                                                labels, output.label_indices,
                                                boundaries));
  EXPECT_TRUE(boundaries.empty());
  EXPECT_TRUE(segmentation.getResult().regions.empty())
      << "an old result is still there";

  segmentation = Segmentation();
  segmentation.setTileSize(10, 10);
  segmentation.setInputCloud(roomCloud());
  output.run(segmentation);
  EXPECT_FALSE(output.models.empty()) << "the class must work again with a good cloud";
  pcl::console::setVerbosityLevel(pcl::console::L_INFO);
}

TEST(ClassInputTest, AFailedRunDoesNotSpoilTheNextOne)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  Segmentation segmentation;
  segmentation.setTileSize(10, 10);
  segmentation.setInputCloud(roomCloud());
  Output expected;
  expected.run(segmentation);
  segmentation.setIterations(-1);
  Output output;
  output.run(segmentation);
  EXPECT_TRUE(output.models.empty());
  segmentation.setIterations(5);
  output.run(segmentation);
  EXPECT_EQ(output.labelValues(), expected.labelValues())
      << "deinitCompute() was not called on the way out";
  pcl::console::setVerbosityLevel(pcl::console::L_INFO);
}

} // namespace
} // namespace pcl_mrf_planes
