// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"
#include "adaptive/block_costs.h"
#include "adaptive/edge_weights.h"

#include <algorithm>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
constexpr std::size_t BLOCK_LEVEL = 1; // tiles that are the blocks
static_assert(SIDE == 2 * CELL, "tiles of the level above the cells are the blocks");

/// So many that the largest sum, a data cost and four messages, stays below 2^15.
CostUnits costUnits(const AdaptiveParameters& parameters)
{
  constexpr int ROUNDING = 5; // terms of a sum, each rounded up at worst
  const double largest_sum =
      BlockCosts::MOST * parameters.none_cost + 4.0 * parameters.label_change;
  return {static_cast<float>((INT16_MAX - ROUNDING) / largest_sum)};
}

/// Fills a field block by block.
class FieldBuilder {
public:
  FieldBuilder(const OrganizedPoints& points, const TileRegions& regions,
               const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
               const AdaptiveParameters& parameters, CandidateField& field)
  : block_sums_(pyramid[BLOCK_LEVEL].sums)
  , costs_(points, regions, pyramid[0], noise, parameters, costUnits(parameters))
  , weights_(points, noise, parameters, costUnits(parameters))
  , field_(field)
  {}

  void add(const BlockPlace& place)
  {
    field_.number.push_back(CandidateField::SETTLED);
    std::uint8_t& count = field_.blocks.count[place.block];
    std::uint16_t* labels = &field_.blocks.labels[place.block * SLOTS];
    if (count < 2)
      return;
    std::size_t settled = 1;
    if (count > 2 || !costs_.fitAsAWhole(block_sums_[place.block], labels[1])) {
      costs_.fill(place, labels, count);
      count = static_cast<std::uint8_t>(costs_.dropHopeless(labels, count));
      settled = costs_.settledLabel(count);
    }
    if (settled == BlockCosts::OPEN) {
      activate(place);
      return;
    }
    labels[0] = labels[settled];
    count = 1;
  }

private:
  void activate(const BlockPlace& place)
  {
    const std::size_t count = field_.blocks.count[place.block];
    field_.number.back() = field_.active.size();
    field_.active.push_back(place.block);
    field_.first.push_back(field_.data.size());
    field_.data.resize(field_.data.size() + SIDE * count);
    BlockRow* out = &field_.data[field_.first.back()];
    for (std::size_t r = 0; r < SIDE; ++r)
      for (std::size_t s = 0; s < count; ++s)
        (out++)->v = costs_.at(r, s);
    field_.weight.emplace_back();
    const TileSums& sums = block_sums_[place.block];
    weights_.fill(place, sums.n > 0 ? sums.centroid().norm() : 1.0,
                  field_.weight.back());
  }

  const std::vector<TileSums>& block_sums_;
  BlockCosts costs_;
  EdgeWeights weights_;
  CandidateField& field_;
};

} // namespace

double unitsPerSigma(const AdaptiveParameters& parameters)
{
  return costUnits(parameters).per_sigma;
}

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  CandidateField field;
  field.width = points.width;
  field.height = points.height;
  field.blocks = findCandidates(regions, pyramid[0], field.width, field.height,
                                parameters.support_reach);
  field.weight.reserve(
      field.blocks.count.size()); // pages that are not used cost nothing
  field.data.reserve(field.blocks.count.size() * static_cast<std::size_t>(SIDE));
  FieldBuilder builder(points, regions, pyramid, noise, parameters, field);
  for (int row = 0; row < field.blocks.rows; ++row)
    for (int column = 0; column < field.blocks.columns; ++column)
      builder.add({field.blocks.at(column, row), column * SIDE, row * SIDE,
                   std::min(SIDE, field.width - column * SIDE),
                   std::min(SIDE, field.height - row * SIDE)});
  return field;
}

} // namespace pcl_mrf_planes::adaptive
