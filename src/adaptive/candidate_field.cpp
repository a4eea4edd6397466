// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"
#include "adaptive/block_costs.h"
#include "adaptive/edge_weights.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
static_assert(SIDE == 2 * CELL, "tiles of the level above the cells are the blocks");

/// So many that the largest sum, a data cost and four messages, stays below 2^15.
CostUnits costUnits(const AdaptiveParameters& parameters)
{
  constexpr int ROUNDING = 5; // terms of a sum, each rounded up at worst
  const double largest_sum =
      BlockCosts::MOST * parameters.none_cost + 4.0 * parameters.label_change;
  return {static_cast<float>((INT16_MAX - ROUNDING) / largest_sum)};
}

/// What all blocks' costs and weights are made from.
struct FieldSources {
  const OrganizedPoints& points;
  const std::vector<TileLevel>& pyramid;
  const NoiseLaw& noise;
  const AdaptiveParameters& parameters;
  FrameVector<LabelScale> scales;
  const float* depth; ///< of each point

  /// \param ranges memory for those of the points
  FieldSources(const OrganizedPoints& of_points, const TileRegions& regions,
               const std::vector<TileLevel>& of_pyramid, const NoiseLaw& of_noise,
               const AdaptiveParameters& of_parameters, unsigned int threads,
               std::vector<float>& ranges)
  : points(of_points)
  , pyramid(of_pyramid)
  , noise(of_noise)
  , parameters(of_parameters)
  , depth(points.z.data())
  {
    scales.reserve(regions.planes.size());
    for (const FittedPlane& plane : regions.planes)
      scales.push_back(labelScale(plane, noise, parameters));
    if (points.depth_measure == DepthMeasure::RANGE)
      measureRanges(threads, ranges);
  }

private:
  void measureRanges(unsigned int threads, std::vector<float>& ranges)
  {
    ranges.resize(points.size());
    const auto width = static_cast<std::size_t>(points.width);
    parallelRows(points.height, threads, [&](int row) {
      const std::size_t first = static_cast<std::size_t>(row) * width;
      for (std::size_t i = first; i < first + width; ++i)
        ranges[i] = points.depth(i);
    });
    depth = ranges.data();
  }
};

/// Fills a part of a field block by block.
class FieldBuilder {
public:
  FieldBuilder(const FieldSources& sources, CandidateField& field, FieldPart& part)
  : block_sums_(sources.pyramid[BLOCK_LEVEL].sums)
  , costs_(sources.points, sources.scales, sources.pyramid[0], sources.parameters,
           costUnits(sources.parameters))
  , weights_(sources.points, sources.depth, sources.noise, sources.parameters,
             costUnits(sources.parameters))
  , field_(field)
  , part_(part)
  {}

  /// For so many blocks; pages that are not used cost nothing.
  void start(std::size_t blocks)
  {
    part_.active.clear();
    part_.first.clear();
    part_.data.clear();
    part_.weight.clear();
    part_.weight.reserve(blocks);
    part_.data.reserve(blocks * static_cast<std::size_t>(SIDE));
  }

  void addRow(int row)
  {
    for (int column = 0; column < field_.blocks.columns; ++column)
      add({field_.blocks.at(column, row), column * SIDE, row * SIDE,
           std::min(SIDE, field_.width - column * SIDE),
           std::min(SIDE, field_.height - row * SIDE)});
  }

private:
  void add(const BlockPlace& place)
  {
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

  void activate(const BlockPlace& place)
  {
    const std::size_t count = field_.blocks.count[place.block];
    part_.active.push_back(place.block);
    part_.first.push_back(part_.data.size());
    part_.data.resize(part_.data.size() + SIDE * count);
    BlockRow* out = &part_.data[part_.first.back()];
    for (std::size_t r = 0; r < SIDE; ++r)
      for (std::size_t s = 0; s < count; ++s)
        (out++)->v = costs_.at(r, s);
    part_.weight.emplace_back();
    const TileSums& sums = block_sums_[place.block];
    weights_.fill(place, sums.n > 0 ? sums.centroid().norm() : 1.0,
                  part_.weight.back());
  }

  const std::vector<TileSums>& block_sums_;
  BlockCosts costs_;
  EdgeWeights weights_;
  CandidateField& field_;
  FieldPart& part_;
};

/// Puts the parts of a field together, in their order.
void joinParts(std::vector<FieldPart>& parts, unsigned int threads,
               CandidateField& field)
{
  if (parts.size() == 1) {
    for (std::size_t a = 0; a < parts[0].active.size(); ++a)
      field.number[parts[0].active[a]] = a;
    std::swap(field.active, parts[0].active);
    std::swap(field.first, parts[0].first);
    std::swap(field.data, parts[0].data);
    std::swap(field.weight, parts[0].weight);
    return;
  }
  struct Start {
    std::size_t active = 0, data = 0;
  };
  FrameVector<Start> starts(parts.size() + 1);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    starts[k + 1].active = starts[k].active + parts[k].active.size();
    starts[k + 1].data = starts[k].data + parts[k].data.size();
  }
  field.active.resize(starts.back().active);
  field.first.resize(starts.back().active);
  field.weight.resize(starts.back().active);
  field.data.resize(starts.back().data);
  parallelParts(static_cast<int>(parts.size()), threads, [&](int number) {
    const FieldPart& part = parts[static_cast<std::size_t>(number)];
    const Start& start = starts[static_cast<std::size_t>(number)];
    for (std::size_t a = 0; a < part.active.size(); ++a) {
      field.number[part.active[a]] = start.active + a;
      field.active[start.active + a] = part.active[a];
      field.first[start.active + a] = start.data + part.first[a];
      field.weight[start.active + a] = part.weight[a];
    }
    std::copy(part.data.begin(), part.data.end(),
              field.data.begin() + static_cast<std::ptrdiff_t>(start.data));
  });
}

} // namespace

double unitsPerSigma(const AdaptiveParameters& parameters)
{
  return costUnits(parameters).per_sigma;
}

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters, unsigned int threads)
{
  FieldMemory memory;
  buildField(points, regions, pyramid, noise, parameters, threads, memory);
  return std::move(memory.field);
}

void buildField(const OrganizedPoints& points, const TileRegions& regions,
                const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, unsigned int threads,
                FieldMemory& memory)
{
  CandidateField& field = memory.field;
  field.width = points.width;
  field.height = points.height;
  findCandidates(regions, pyramid[0], field.width, field.height,
                 parameters.support_reach, threads, field.blocks);
  field.number.assign(field.blocks.count.size(), CandidateField::SETTLED);
  const FieldSources sources(points, regions, pyramid, noise, parameters, threads,
                             memory.ranges);
  const Bands bands(field.blocks.rows, threadCount(threads) > 1 ? 32 : 1);
  std::vector<FieldPart>& parts = memory.parts;
  parts.resize(static_cast<std::size_t>(bands.count));
  parallelParts(bands.count, threads, [&](int band) {
    FieldBuilder builder(sources, field, parts[static_cast<std::size_t>(band)]);
    builder.start(field.blocks.at(0, bands.begin(band + 1) - bands.begin(band)));
    for (int row = bands.begin(band); row < bands.begin(band + 1); ++row)
      builder.addRow(row);
  });
  joinParts(parts, threads, field);
}

} // namespace pcl_mrf_planes::adaptive
