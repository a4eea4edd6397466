// SPDX-License-Identifier: BSD-3-Clause
//
// Memory that is kept from cloud to cloud, and threads that are woken once, change no result.
#include "reference/inputs.h"
#include "reference/result_hash.h"

#include <pcl_mrf_planes/label_confidence.h>
#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/thread_scope.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes {
namespace {

OrganizedPoints picture(const char* scene, int width, int height)
{
  return reference::toPoints(
      reference::takePicture(scene, width, height, 4, scenes::SensorNoise::kinect()));
}

/// Large after small and the other way round, with many labels and with few, of sizes that
/// FAST samples by different steps, and one in which there is nothing.
std::vector<OrganizedPoints> sequence()
{
  std::vector<OrganizedPoints> clouds = {
      picture("room", 160, 120), picture("corner", 420, 330), picture("room", 331, 237),
      picture("corner", 97, 33), picture("room", 420, 330)};
  clouds.emplace_back();
  clouds.back().resize(200, 150);
  clouds.push_back(picture("step", 161, 121));
  return clouds;
}

std::vector<Parameters> allProfiles()
{
  std::vector<Parameters> all;
  for (const Profile profile : {Profile::DEFAULT, Profile::FAST, Profile::PAPER})
    all.push_back(Parameters::fromProfile(profile));
  return all;
}

TEST(PlaneSegmenterTest, SegmentsEachCloudAsIfItWereTheFirst)
{
  const std::vector<OrganizedPoints> clouds = sequence();
  for (const unsigned int threads : {1U, 3U}) {
    PlaneSegmenter segmenter;
    PlaneSegmentation result;
    for (Parameters parameters : allProfiles()) {
      parameters.number_of_threads = threads;
      for (std::size_t k = 0; k < clouds.size(); ++k) {
        const PlaneSegmentation alone = segmentPlanes(clouds[k], parameters);
        segmenter.segment(clouds[k], parameters, result);
        EXPECT_EQ(reference::resultHash(result), reference::resultHash(alone))
            << "cloud " << k << ", " << threads << " threads";
        EXPECT_EQ(result.report.planes, alone.report.planes);
        EXPECT_EQ(result.report.stage_ms.size(), alone.report.stage_ms.size());
        EXPECT_EQ(result.block_noise == nullptr, alone.block_noise == nullptr);
      }
    }
  }
}

TEST(PlaneSegmenterTest, ConfidenceIsThatOfTheCloudSegmentedLast)
{
  const std::vector<OrganizedPoints> clouds = sequence();
  PlaneSegmenter segmenter;
  PlaneSegmentation result;
  for (const Parameters& parameters : allProfiles())
    for (const OrganizedPoints& cloud : clouds) {
      segmenter.segment(cloud, parameters, result);
      EXPECT_EQ(labelConfidence(cloud, result, parameters),
                labelConfidence(cloud, segmentPlanes(cloud, parameters), parameters));
    }
}

TEST(PlaneSegmenterTest, CopiesAndMovesShareNothing)
{
  const OrganizedPoints room = picture("room", 160, 120);
  const OrganizedPoints corner = picture("corner", 210, 130);
  const Parameters parameters;
  const std::uint64_t of_room = reference::resultHash(segmentPlanes(room, parameters));
  const std::uint64_t of_corner =
      reference::resultHash(segmentPlanes(corner, parameters));
  const auto hash = [&](PlaneSegmenter& segmenter, const OrganizedPoints& points) {
    PlaneSegmentation result;
    segmenter.segment(points, parameters, result);
    return reference::resultHash(result);
  };
  PlaneSegmenter first;
  EXPECT_EQ(hash(first, room), of_room);
  PlaneSegmenter copy(first);
  EXPECT_EQ(hash(copy, corner), of_corner);
  EXPECT_EQ(hash(first, room), of_room);
  PlaneSegmenter moved(std::move(first));
  EXPECT_EQ(hash(moved, corner), of_corner);
  copy = moved;
  EXPECT_EQ(hash(copy, room), of_room);
  first = std::move(copy);
  EXPECT_EQ(hash(first, room), of_room);
}

TEST(ThreadScopeTest, ResultsAreTheSameInside)
{
  for (Parameters parameters : allProfiles()) {
    parameters.number_of_threads = 2;
    const OrganizedPoints points = picture("room", 160, 120);
    const std::uint64_t outside =
        reference::resultHash(segmentPlanes(points, parameters));
    const ThreadScope two(2);
    const ThreadScope inner(3); // the outer one stays
    for (int run = 0; run < 2; ++run)
      EXPECT_EQ(reference::resultHash(segmentPlanes(points, parameters)), outside);
  }
}

} // namespace
} // namespace pcl_mrf_planes
