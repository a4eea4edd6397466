// SPDX-License-Identifier: BSD-3-Clause
//
// The same bits for every number of threads, on every instruction set, again and again.
#include "reference/inputs.h"
#include "reference/result_hash.h"

#include <pcl_mrf_planes/plane_segmentation.h>

#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <string>

namespace pcl_mrf_planes {
namespace {

class Determinism : public ::testing::TestWithParam<Profile> {
protected:
  std::uint64_t hashWith(unsigned int threads) const
  {
    Parameters parameters = Parameters::fromProfile(GetParam());
    parameters.number_of_threads = threads;
    return reference::resultHash(segmentPlanes(points_, parameters));
  }

  /// Sizes that divide into no blocks, tiles or lanes.
  OrganizedPoints points_ = reference::toPoints(
      reference::takePicture("room", 331, 237, 9, scenes::SensorNoise::kinect()));
};

TEST_P(Determinism, ThreadsDoNotChangeABit)
{
  const std::uint64_t one = hashWith(1);
  for (const unsigned int threads : {2U, 3U, 8U, 0U})
    EXPECT_EQ(hashWith(threads), one) << threads << " threads";
}

TEST_P(Determinism, NorDoRepetitions)
{
  const std::uint64_t first = hashWith(3);
  for (int run = 0; run < 5; ++run)
    EXPECT_EQ(hashWith(3), first) << "repetition " << run;
}

TEST_P(Determinism, NorInstructionSetsWithAnyNumberOfThreads)
{
  const std::uint64_t best = hashWith(1);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (const unsigned int threads : {1U, 3U})
      EXPECT_EQ(hashWith(threads), best)
          << hwy::TargetName(target) << ", " << threads << " threads";
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST_P(Determinism, TheHashSeesEveryLabel)
{
  PlaneSegmentation result =
      segmentPlanes(points_, Parameters::fromProfile(GetParam()));
  const std::uint64_t before = reference::resultHash(result);
  result.labels.back() ^= 1U;
  EXPECT_NE(reference::resultHash(result), before);
}

INSTANTIATE_TEST_SUITE_P(Profiles, Determinism,
                         testing::Values(Profile::DEFAULT, Profile::FAST,
                                         Profile::PAPER));

} // namespace
} // namespace pcl_mrf_planes
