// SPDX-License-Identifier: BSD-3-Clause
//
// The record of the stages: exact, in order, and with energies that mean something.
#include "adaptive/field_energy.h"
#include "reference/inputs.h"

#include <pcl_mrf_planes/segmentation_stages.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace pcl_mrf_planes {
namespace {

OrganizedPoints room(int width = 160, int height = 120)
{
  return reference::toPoints(
      reference::takePicture("room", width, height, 3, scenes::SensorNoise::kinect()));
}

Parameters paper()
{
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.tile_width = parameters.tile_height = 16;
  parameters.noise_multiplier = 3.0;
  return parameters;
}

/// What every record must keep to.
void expectSound(const OrganizedPoints& points, const SegmentationStages& stages)
{
  EXPECT_EQ(stages.width, points.width);
  EXPECT_EQ(stages.height, points.height);
  ASSERT_FALSE(stages.labels.empty());
  for (const StageLabels& after : stages.labels) {
    ASSERT_EQ(after.labels.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_LE(after.labels[i], after.planes.size()) << stageName(after.stage);
      if (points.valid[i] == 0) {
        ASSERT_EQ(after.labels[i], 0) << stageName(after.stage);
      }
    }
  }
  for (const StageTile& tile : stages.tiles) {
    EXPECT_GE(tile.x, 0);
    EXPECT_GE(tile.y, 0);
    EXPECT_GT(tile.width, 0);
    EXPECT_GT(tile.height, 0);
    EXPECT_LE(tile.x + tile.width, points.width);
    EXPECT_LE(tile.y + tile.height, points.height);
    EXPECT_LT(tile.merged, static_cast<int>(stages.merged_planes.size()));
    EXPECT_GE(tile.rms, 0.0);
  }
}

/// Root mean square distance of the points of a tile, summed in plain words.
double rmsOf(const OrganizedPoints& points, const StageTile& tile)
{
  double sum = 0.0;
  int count = 0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const auto i = static_cast<std::size_t>(y * points.width + x);
      if (points.valid[i] == 0)
        continue;
      const double r =
          tile.plane.distance(Eigen::Vector3d(points.x[i], points.y[i], points.z[i]));
      sum += r * r;
      ++count;
    }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

void expectSameResult(const PlaneSegmentation& p, const PlaneSegmentation& q)
{
  EXPECT_EQ(p.labels, q.labels);
  ASSERT_EQ(p.regions.size(), q.regions.size());
  for (std::size_t k = 0; k < p.regions.size(); ++k) {
    EXPECT_EQ(p.regions[k].plane.normal, q.regions[k].plane.normal);
    EXPECT_EQ(p.regions[k].plane.d, q.regions[k].plane.d);
  }
}

class StagesTest : public testing::TestWithParam<Profile> {
protected:
  Parameters parameters() const
  {
    return GetParam() == Profile::PAPER ? paper() : Parameters::fromProfile(GetParam());
  }
};

TEST_P(StagesTest, TheLastRecordIsTheResult)
{
  const OrganizedPoints points = room();
  const SegmentationStages stages = recordStages(points, parameters());
  expectSound(points, stages);
  const PlaneSegmentation result = segmentPlanes(points, parameters());
  ASSERT_FALSE(result.regions.empty()) << "a scene without planes tests nothing";
  expectSameResult(stages.result, result);
  EXPECT_EQ(stages.labels.back().stage, Stage::FINAL);
  EXPECT_EQ(stages.labels.back().labels, result.labels);
}

TEST_P(StagesTest, EveryIterationIsThatOfASegmentationWithSoMany)
{
  const OrganizedPoints points = room();
  const SegmentationStages stages = recordStages(points, parameters());
  int seen = 0;
  for (const StageLabels& after : stages.labels) {
    if (after.stage != Stage::ITERATION)
      continue;
    EXPECT_EQ(after.count, seen++);
    Parameters fewer = parameters();
    fewer.iterations = after.count;
    fewer.adaptive.passes = after.count;
    const SegmentationStages again = recordStages(points, fewer);
    const auto last = std::find_if(
        again.labels.rbegin(), again.labels.rend(),
        [](const StageLabels& labels) { return labels.stage == Stage::ITERATION; });
    ASSERT_NE(last, again.labels.rend());
    EXPECT_EQ(after.labels, last->labels) << after.count;
  }
  const bool is_paper = GetParam() == Profile::PAPER;
  EXPECT_EQ(seen,
            1 + (is_paper ? parameters().iterations : parameters().adaptive.passes));
}

TEST_P(StagesTest, TilesHaveTheErrorOfTheirPoints)
{
  Parameters all = parameters();
  all.adaptive.sampling = 1;
  const OrganizedPoints points = room();
  const SegmentationStages stages = recordStages(points, all);
  int kept = 0;
  for (const StageTile& tile : stages.tiles)
    if (tile.kept) {
      ++kept;
      EXPECT_NEAR(tile.rms, rmsOf(points, tile), 1e-5);
    }
  EXPECT_EQ(static_cast<std::size_t>(kept), stages.result.report.tiles_kept);
  EXPECT_EQ(stages.merged_planes.size(), stages.result.report.planes_after_merging);
}

TEST_P(StagesTest, TilesCarryTheLabelThatTheyWereMergedTo)
{
  const OrganizedPoints points = room();
  const SegmentationStages stages = recordStages(points, parameters());
  const StageLabels* merged = nullptr;
  for (const StageLabels& after : stages.labels)
    if (after.stage == Stage::MERGED || after.stage == Stage::JOINED)
      merged = &after;
  ASSERT_NE(merged, nullptr);
  for (const StageTile& tile : stages.tiles)
    for (int y = tile.y; y < tile.y + tile.height; ++y)
      for (int x = tile.x; x < tile.x + tile.width; ++x) {
        const auto i = static_cast<std::size_t>(y * points.width + x);
        if (points.valid[i] != 0) {
          ASSERT_EQ(merged->labels[i], tile.merged + 1);
        }
      }
}

TEST_P(StagesTest, TheEnergyFalls)
{
  const SegmentationStages stages = recordStages(room(), parameters());
  const StageLabels* first = nullptr;
  const StageLabels* last = nullptr;
  for (const StageLabels& after : stages.labels) {
    EXPECT_EQ(after.energy.has_value(), after.stage == Stage::ITERATION);
    if (after.energy.has_value()) {
      first = first == nullptr ? &after : first;
      last = &after;
    }
  }
  ASSERT_NE(first, nullptr);
  EXPECT_LT(last->energy->total(), first->energy->total());
  EXPECT_LE(first->energy->data, last->energy->data + 1e-9)
      << "at first every point takes the cheapest label";
}

TEST_P(StagesTest, CloudsWithoutPlanesOrPointsHaveARecordToo)
{
  OrganizedPoints nothing;
  nothing.resize(33, 17);
  for (std::size_t i = 0; i < nothing.size(); ++i)
    nothing.set(i, reference::NOT_MEASURED, 0.0f, 0.0f);
  const SegmentationStages stages = recordStages(nothing, parameters());
  expectSound(nothing, stages);
  EXPECT_EQ(stages.labels.back().stage, Stage::FINAL);
  EXPECT_TRUE(stages.merged_planes.empty());
}

INSTANTIATE_TEST_SUITE_P(Profiles, StagesTest,
                         testing::Values(Profile::DEFAULT, Profile::FAST,
                                         Profile::PAPER));

TEST(StagesOfTheDefaultTest, JoiningIsRecordedWhereItIsDone)
{
  const OrganizedPoints points = room();
  for (const bool joins : {true, false}) {
    Parameters parameters;
    parameters.adaptive.join_coplanar = joins;
    const SegmentationStages stages = recordStages(points, parameters);
    expectSound(points, stages);
    expectSameResult(stages.result, segmentPlanes(points, parameters));
    const auto joined = std::count_if(
        stages.labels.begin(), stages.labels.end(),
        [](const StageLabels& labels) { return labels.stage == Stage::JOINED; });
    EXPECT_EQ(joined, joins ? 1 : 0);
  }
}

TEST(StagesOfThePaperTest, EnergiesAreThoseOfTheReport)
{
  const OrganizedPoints points = room();
  Parameters parameters = paper();
  parameters.compute_energy = true;
  const SegmentationStages stages = recordStages(points, parameters);
  const std::vector<FieldEnergy>& reported = stages.result.report.energy;
  std::size_t k = 0;
  for (const StageLabels& after : stages.labels)
    if (after.energy.has_value()) {
      ASSERT_LT(k, reported.size());
      EXPECT_EQ(after.energy->data, reported[k].data);
      EXPECT_EQ(after.energy->smoothness, reported[k].smoothness);
      ++k;
    }
  EXPECT_EQ(k, reported.size());
}

TEST(StagesOfThePaperTest, TheLastIterationIsTheResultBeforeRegionsAreSorted)
{
  const OrganizedPoints points = room();
  const SegmentationStages stages = recordStages(points, paper());
  const StageLabels& last = *(stages.labels.end() - 2);
  ASSERT_EQ(last.stage, Stage::ITERATION);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const std::uint16_t label = stages.result.labels[i]; label != 0) {
      ASSERT_EQ(stages.result.regions[label - 1U].label + 1, last.labels[i]);
    }
}

TEST(FieldEnergyTest, NoPlaneEverywhereCostsItsPriceAtEveryPoint)
{
  using namespace adaptive;
  const OrganizedPoints points = room();
  const AdaptiveParameters parameters;
  std::vector<TileLevel> pyramid = buildTilePyramid(points, parameters);
  const NoiseLaw noise = estimateNoise(pyramid, parameters);
  assignLocalNoise(pyramid, noise, parameters);
  const TileRegions regions = mergeTouching(selectTiles(pyramid, noise, parameters),
                                            pyramid, noise, parameters);
  const CandidateField field = buildField(points, regions, pyramid, noise, parameters);
  double open_points = 0.0;
  for (const std::size_t block : field.active)
    for (int r = 0; r < CandidateBlocks::SIDE; ++r)
      for (int k = 0; k < CandidateBlocks::SIDE; ++k) {
        const int x = static_cast<int>(block) % field.blocks.columns * 8 + k;
        const int y = static_cast<int>(block) / field.blocks.columns * 8 + r;
        if (x < points.width && y < points.height)
          open_points += points.valid[static_cast<std::size_t>(y * points.width + x)];
      }
  ASSERT_GT(open_points, 100.0);
  const std::vector<std::uint16_t> none(points.size(), 0);
  const FieldEnergy energy = fieldEnergy(field, points, none, parameters);
  EXPECT_NEAR(energy.data, open_points * parameters.none_cost, 0.001 * energy.data);
  EXPECT_EQ(energy.smoothness, 0.0);
}

TEST(StageNameTest, EveryStageHasOneOfItsOwn)
{
  std::set<std::string> names;
  for (const Stage stage : {Stage::MERGED, Stage::JOINED, Stage::CELLS,
                            Stage::ITERATION, Stage::REFINED, Stage::FINAL})
    names.insert(stageName(stage));
  EXPECT_EQ(names.size(), 6U);
  EXPECT_EQ(names.count(""), 0U);
  EXPECT_EQ(stageName(Stage::FINAL), "final");
}

} // namespace
} // namespace pcl_mrf_planes
