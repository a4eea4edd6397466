// SPDX-License-Identifier: BSD-3-Clause
//
// The random field of the cells: its energy in plain words, and scenes with known answers.
#include "adaptive/cell_labelling.h"
#include "adaptive/label_scale.h"
#include "reference/inputs.h"
#include "scenes/scene_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl_mrf_planes::adaptive {
namespace {

/// Stages before the cells are labelled, as the segmentation runs them.
struct Merged {
  AdaptiveParameters parameters;
  OrganizedPoints points;
  std::vector<TileLevel> pyramid;
  NoiseLaw noise;
  TileRegions regions;

  Merged(scenes::View view, const scenes::SensorNoise& sensor, std::uint64_t seed)
  {
    view.camera.resize(320, 240);
    points = reference::toPoints(scenes::render(view.scene, view.camera, sensor, seed));
    pyramid = buildTilePyramid(points, parameters);
    noise = estimateNoise(pyramid, parameters);
    assignLocalNoise(pyramid, noise, parameters);
    regions = mergeTouching(selectTiles(pyramid, noise, parameters), pyramid, noise,
                            parameters);
  }

  TileRegions labelled() const
  {
    return labelCells(regions, pyramid, noise, parameters);
  }
};

/// Energy of labels of the cells by planes that stay as they were.
double energyOf(const Merged& m, const FrameVector<int>& labels)
{
  const TileLevel& cells = m.pyramid[0];
  double energy = 0;
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      const std::size_t i = cells.at(c, r);
      const TileSums& s = cells.sums[i];
      if (labels[i] < 0 || s.n < 1)
        energy += s.n * m.parameters.none_cost;
      else {
        const auto& plane = m.regions.planes[static_cast<std::size_t>(labels[i])];
        const LabelScale scale = labelScale(plane, m.noise, m.parameters);
        const double sigma = std::sqrt(scale.growth * s.noise / s.n + scale.bend);
        energy += s.n * s.rmsDistance(plane) / sigma;
      }
      const double change = CELL * m.parameters.label_change;
      if (c + 1 < cells.columns)
        energy += labels[i] != labels[cells.at(c + 1, r)] ? change : 0;
      if (r + 1 < cells.rows)
        energy += labels[i] != labels[cells.at(c, r + 1)] ? change : 0;
    }
  return energy;
}

/// Labels of the result by the numbers of the planes before, if all of them are left.
FrameVector<int> withOldNumbers(const Merged& m, const TileRegions& result)
{
  EXPECT_EQ(result.planes.size(), m.regions.planes.size());
  return result.cell_region;
}

TEST(CellLabellingTest, TheEnergyFalls)
{
  for (const auto& view : {scenes::corner(), scenes::step(0.2), scenes::makeRoom(2)}) {
    const Merged merged(view, scenes::SensorNoise::kinect(), 3);
    const TileRegions result = merged.labelled();
    if (result.planes.size() != merged.regions.planes.size())
      continue; // numbers have moved
    const auto after = withOldNumbers(merged, result);
    // Cells without points cost nothing either way, but for the changes.
    EXPECT_LT(energyOf(merged, after), energyOf(merged, merged.regions.cell_region));
  }
}

TEST(CellLabellingTest, SumsArePooledFromTheCellsOfEachPlane)
{
  const Merged merged(scenes::makeRoom(1), scenes::SensorNoise::kinect(), 1);
  const TileRegions result = merged.labelled();
  ASSERT_EQ(result.cell_region.size(), merged.pyramid[0].sums.size());
  std::vector<double> n(result.planes.size(), 0), z(result.planes.size(), 0);
  for (std::size_t i = 0; i < result.cell_region.size(); ++i)
    if (const int id = result.cell_region[i]; id >= 0) {
      ASSERT_LT(static_cast<std::size_t>(id), n.size());
      n[static_cast<std::size_t>(id)] += merged.pyramid[0].sums[i].n;
      z[static_cast<std::size_t>(id)] += merged.pyramid[0].sums[i].z;
    }
  for (std::size_t k = 0; k < n.size(); ++k) {
    EXPECT_EQ(result.sums[k].n, n[k]) << "plane " << k;
    EXPECT_NEAR(result.sums[k].z, z[k], 1e-9 * std::abs(z[k])) << "plane " << k;
    EXPECT_TRUE(isPlane(result.planes[k], 0.5 * merged.parameters.min_points,
                        merged.noise, merged.parameters))
        << "plane " << k;
  }
}

TEST(CellLabellingTest, APlaneGrowsOverWhatFitsIt)
{
  Merged merged(scenes::corner(), scenes::SensorNoise::kinect(), 5);
  // All but a few cells of each plane forget their label.
  std::map<int, int> kept;
  for (int& id : merged.regions.cell_region)
    if (id >= 0 && kept[id]++ >= 200)
      id = -1;
  const auto count = [](const FrameVector<int>& labels) {
    return std::count_if(labels.begin(), labels.end(), [](int id) { return id >= 0; });
  };
  const auto before = count(merged.regions.cell_region);
  const auto cells = static_cast<std::ptrdiff_t>(merged.regions.cell_region.size());
  ASSERT_LT(before, cells / 4);
  EXPECT_GT(count(merged.labelled().cell_region), cells * 9 / 10)
      << "down and up again a plane reaches all that it fits";
}

TEST(CellLabellingTest, NothingGivesNothing)
{
  Merged merged(scenes::corner(), scenes::SensorNoise::none(), 1);
  merged.regions = TileRegions();
  merged.regions.cell_region.assign(merged.pyramid[0].sums.size(), -1);
  const TileRegions result = merged.labelled();
  EXPECT_TRUE(result.planes.empty());
  EXPECT_EQ(result.cell_region, merged.regions.cell_region);
}

} // namespace
} // namespace pcl_mrf_planes::adaptive
