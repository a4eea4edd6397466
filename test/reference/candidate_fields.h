// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/cell_labelling.h"
#include "adaptive/flatness.h"
#include "reference/candidate_energy.h"
#include "reference/inputs.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

/** Random fields and fields of scenes for Method::ADAPTIVE. */
namespace pcl_mrf_planes::adaptive::reference {

constexpr int ALL_LABELS = 20; ///< of random fields

inline OrganizedPoints allValid(int width, int height)
{
  OrganizedPoints points;
  points.resize(width, height);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.set(i, 0.0f, 0.0f, 1.0f);
  return points;
}

/// Labels that a block may have, "no plane" among them.
struct LabelCount {
  int least, most; ///< 2 to CandidateBlocks::SLOTS
};

/// Random candidates of a block.
inline void addBlock(scenes::Random& random, LabelCount labels_of_a_block,
                     CandidateField& field)
{
  CandidateBlocks& blocks = field.blocks;
  std::vector<std::uint16_t> labels = {0};
  const auto count = static_cast<std::size_t>(
      random.integer(labels_of_a_block.least, labels_of_a_block.most));
  while (labels.size() < count) {
    const auto label = static_cast<std::uint16_t>(random.integer(1, ALL_LABELS - 1));
    if (std::find(labels.begin(), labels.end(), label) == labels.end())
      labels.push_back(label);
  }
  field.number.push_back(field.active.size());
  field.active.push_back(blocks.count.size());
  field.first.push_back(field.data.size());
  field.data.resize(field.data.size() + count * static_cast<std::size_t>(SIDE));
  field.weight.emplace_back();
  blocks.count.push_back(static_cast<std::uint8_t>(count));
  labels.resize(CandidateBlocks::SLOTS, 0);
  blocks.labels.insert(blocks.labels.end(), labels.begin(), labels.end());
}

/// Random labels, costs and prices that use up the 16 bits.
inline CandidateField randomField(scenes::Random& random, int width, int height,
                                  LabelCount labels_of_a_block = {3, 8})
{
  constexpr int LARGEST_DATA = 12767; // and four prices of 5000 make 32767
  constexpr int LARGEST_PRICE = 5000;
  CandidateField field;
  field.width = width;
  field.height = height;
  field.blocks.columns = (width + SIDE - 1) / SIDE;
  field.blocks.rows = (height + SIDE - 1) / SIDE;
  for (int block = 0; block < field.blocks.columns * field.blocks.rows; ++block)
    addBlock(random, labels_of_a_block, field);
  const auto price = [&] {
    return static_cast<std::int16_t>(
        random.chance(0.1) ? 0 : random.integer(0, LARGEST_PRICE));
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t a = activeOf(field, x, y);
      const auto row = static_cast<std::size_t>(y % SIDE);
      const auto k = static_cast<std::size_t>(x % SIDE);
      for (std::size_t s = 0; s < field.blocks.count[a]; ++s)
        field.data[field.dataRow(a, row) + s].v[k] =
            static_cast<std::int16_t>(random.integer(0, LARGEST_DATA));
      BlockWeights& weight = field.weight[a];
      if (x + 1 < width) {
        weight.right[row].v[k] = price();
        if (x % SIDE + 1 == SIDE)
          field.weight[activeOf(field, x + 1, y)].left.v[row] = weight.right[row].v[k];
      }
      if (y + 1 < height) {
        weight.down[row].v[k] = price();
        if (y % SIDE + 1 == SIDE)
          field.weight[activeOf(field, x, y + 1)].above.v[k] = weight.down[row].v[k];
      }
    }
  return field;
}

/// The field of a cloud's points, and what it was built from.
struct CloudField {
  OrganizedPoints points;
  std::vector<TileLevel> pyramid;
  NoiseLaw noise;
  TileRegions regions;
  CandidateField field;

  CloudField(OrganizedPoints organized_points, AdaptiveParameters parameters)
  : points(std::move(organized_points))
  , pyramid(buildTilePyramid(points, parameters))
  , noise(estimateNoise(pyramid, parameters))
  {
    const double correlation = noise.growth.back() / noise.growth.front();
    parameters.min_points =
        static_cast<int>(parameters.min_points * correlation * correlation);
    assignLocalNoise(pyramid, noise, parameters);
    regions = mergeTouching(selectTiles(pyramid, noise, parameters), pyramid, noise,
                            parameters);
    regions = joinCoplanar(regions, points, pyramid[0], noise, parameters);
    for (int round = 1; round < parameters.rounds; ++round)
      regions = labelCells(regions, pyramid, noise, parameters);
    field = buildField(points, regions, pyramid, noise, parameters);
  }

  /// Equation (7) in sigmas for a label of a point: of its distance from the plane, with the
  /// noise of its cell, no more than three times the cost of "no plane".
  double dataCost(std::size_t i, std::uint16_t label,
                  const AdaptiveParameters& parameters) const
  {
    if (points.valid[i] == 0)
      return 0.0;
    if (label == 0)
      return parameters.none_cost;
    const int x = static_cast<int>(i) % points.width;
    const int y = static_cast<int>(i) / points.width;
    const TileSums& cell = pyramid[0].sums[pyramid[0].at(x / CELL, y / CELL)];
    const FittedPlane& plane = regions.planes[label - 1U];
    const double growth = noise.growthOf(plane.n);
    const double bend = flatnessOf(plane, parameters); // by the noise of all its points
    const double variance =
        growth * growth * incidenceFactor(plane) * cell.noise / cell.n + bend * bend;
    const double distance =
        std::abs(plane.distance(points.x[i], points.y[i], points.z[i]));
    return std::min(distance / std::sqrt(variance), 3 * parameters.none_cost);
  }

  /// Calls visit(point, block, label) for all points of settled blocks.
  template <typename Visit>
  void forEachSettled(const Visit& visit) const
  {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t b = blockOf(field, static_cast<int>(i) % points.width,
                                    static_cast<int>(i) / points.width);
      if (field.number[b] == CandidateField::SETTLED)
        visit(i, b, field.blocks.labelsOf(b)[0]);
    }
  }
};

inline CloudField sceneField(const char* scene, const scenes::SensorNoise& sensor,
                             const AdaptiveParameters& parameters)
{
  using namespace pcl_mrf_planes::reference;
  return {toPoints(takePicture(scene, 323, 243, 2, sensor)), parameters};
}

} // namespace pcl_mrf_planes::adaptive::reference
