// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"
#include "adaptive/label_scale.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t BLOCK_LEVEL = 1; // tiles that are the blocks
static_assert(SIDE == 2 * CELL, "tiles of the level above the cells are the blocks");
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;

/// Eight numbers of an array, as one.
BlockRow::Numbers gather(const std::int16_t* numbers)
{
  BlockRow::Numbers v;
  std::memcpy(&v, numbers, sizeof(v));
  return v;
}

/// A row of eight points; those outside the image are not valid.
struct PointRow {
  float x[SIDE], y[SIDE], z[SIDE];
  std::int16_t valid[SIDE]; ///< all bits set, or none
};

inline void copyPoints(const OrganizedPoints& points, std::size_t i, std::size_t count,
                       PointRow& row)
{
  std::copy_n(&points.x[i], count, row.x);
  std::copy_n(&points.y[i], count, row.y);
  std::copy_n(&points.z[i], count, row.z);
  for (std::size_t k = 0; k < count; ++k)
    row.valid[k] = static_cast<std::int16_t>(-points.valid[i + k]);
}

void loadRow(const OrganizedPoints& points, std::size_t i, int count, PointRow& row)
{
  if (count == SIDE) { // known to the compiler: no loop is left
    copyPoints(points, i, SIDE, row);
    return;
  }
  row = {};
  copyPoints(points, i, static_cast<std::size_t>(count), row);
}

/// A corner of the image: block, column and row of its first point.
struct BlockPlace {
  std::size_t block;
  int column, row;
  int columns, rows; ///< points of it that lie in the image
};

/// Fills a field block by block.
class FieldBuilder {
public:
  FieldBuilder(const OrganizedPoints& points, const TileRegions& regions,
               const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
               const AdaptiveParameters& parameters, CandidateField& field)
  : points_(points)
  , cells_(pyramid[0])
  , block_sums_(pyramid[BLOCK_LEVEL].sums)
  , noise_(noise)
  , parameters_(parameters)
  , field_(field)
  {
    const double largest_sum =
        MOST * parameters.none_cost + 4.0 * parameters.label_change;
    units_ = static_cast<float>((INT16_MAX - ROUNDING) / largest_sum);
    for (const FittedPlane& plane : regions.planes)
      scales_.push_back(labelScale(plane, noise, parameters));
    if (points.depth_measure == DepthMeasure::RANGE)
      for (std::size_t i = 0; i < points.size(); ++i)
        ranges_.push_back(points.depth(i));
    depth_ = ranges_.empty() ? points.z.data() : ranges_.data();
  }

  void add(const BlockPlace& place)
  {
    CandidateBlocks& blocks = field_.blocks;
    std::size_t count = blocks.count[place.block];
    field_.number.push_back(CandidateField::SETTLED);
    if (count < 2)
      return;
    if (count == 2 && fitsAsAWhole(place)) {
      settle(place.block, 1);
      return;
    }
    fillCosts(place);
    dropHopeless(place.block);
    count = blocks.count[place.block];
    if (const std::size_t label = bestSomewhere(count); isSettled(label, count)) {
      settle(place.block, label);
      return;
    }
    field_.number.back() = field_.active.size();
    field_.active.push_back(place.block);
    field_.first.push_back(field_.data.size());
    field_.data.resize(field_.data.size() + SIDE * count);
    BlockRow* out = &field_.data[field_.first.back()];
    for (std::size_t r = 0; r < SIDE; ++r)
      for (std::size_t s = 0; s < count; ++s)
        (out++)->v = costs_[r][s];
    field_.weight.emplace_back();
    fillWeights(place, field_.weight.back());
  }

private:
  void settle(std::size_t block, std::size_t slot)
  {
    CandidateBlocks& blocks = field_.blocks;
    blocks.labels[block * SLOTS] = blocks.labels[block * SLOTS + slot];
    blocks.count[block] = 1;
  }

  /// A block with one plane in which no points can be so far from it that a hole pays. Its k
  /// points save their distances less k times the cost of "no plane", at most
  /// sqrt(k) sqrt(Q) - k none where Q is the sum of squared distances in sigmas; they pay
  /// for a border of at least 4 sqrt(k). That is never worth it while
  /// sqrt(Q) <= none + 4 change. Q follows from the ten sums of the block.
  bool fitsAsAWhole(const BlockPlace& place) const
  {
    const LabelScale& plane = scales_[field_.blocks.labelsOf(place.block)[1] - 1U];
    const TileSums& sums = block_sums_[place.block];
    return squaredDistances(sums, plane) * sums.n <=
           mostSquares() * (plane.growth * sums.noise + plane.bend * sums.n);
  }

  double mostSquares() const
  {
    const double most = parameters_.none_cost + 4 * parameters_.label_change;
    return most * most;
  }

  std::size_t pointAt(const BlockPlace& place, int row) const
  {
    return static_cast<std::size_t>(place.row + row) *
               static_cast<std::size_t>(field_.width) +
           static_cast<std::size_t>(place.column);
  }

  /// Equation (7) in sigmas, for all candidates of a block.
  void fillCosts(const BlockPlace& place)
  {
    const std::size_t count = field_.blocks.count[place.block];
    const std::uint16_t* labels = field_.blocks.labelsOf(place.block);
    const auto none = static_cast<float>(parameters_.none_cost);
    for (int r = 0; r < SIDE; ++r) {
      const auto row = static_cast<std::size_t>(r);
      if (r < place.rows)
        loadRow(points_, pointAt(place, r), place.columns, points_row_);
      else
        points_row_ = {};
      if (r % CELL == 0 && r < place.rows)
        lookUpNoise(place, place.row + r);
      valid_[row] = gather(points_row_.valid);
      costs_[row][0] = units(none) & valid_[row];
      for (std::size_t s = 1; s < count; ++s)
        costs_[row][s] =
            costs(scales_[labels[s] - 1U], per_sigma_[s], MOST * none) & valid_[row];
    }
  }

  BlockRow::Numbers costs(const LabelScale& plane,
                          const std::array<float, SIDE>& per_sigma, float most) const
  {
    const PointRow& p = points_row_;
    const float a = plane.a, b = plane.b, c = plane.c, d = plane.d, scale = units_;
    std::int16_t cost[SIDE];
    for (std::size_t k = 0; k < SIDE; ++k) {
      const float distance = std::abs(a * p.x[k] + b * p.y[k] + c * p.z[k] + d);
      const float sigmas = distance * per_sigma[k];
      cost[k] = static_cast<std::int16_t>(
          static_cast<std::int32_t>((sigmas < most ? sigmas : most) * scale + 0.5f));
    }
    return gather(cost);
  }

  /// Noise is known by cell: looks up what all points of a row share.
  void lookUpNoise(const BlockPlace& place, int row)
  {
    for (int half = 0; half < SIDE / CELL; ++half) {
      const int column = std::min(place.column / CELL + half, cells_.columns - 1);
      const TileSums& sums = cells_.sums[cells_.at(column, row / CELL)];
      const auto variance = static_cast<float>(sums.n > 0 ? sums.noise / sums.n : 1.0);
      for (std::size_t s = 1; s < field_.blocks.count[place.block]; ++s) {
        const LabelScale& scale = scales_[field_.blocks.labelsOf(place.block)[s] - 1U];
        const float per_sigma =
            1.0f / std::sqrt(static_cast<float>(scale.growth) * variance +
                             static_cast<float>(scale.bend));
        std::fill_n(&per_sigma_[s][static_cast<std::size_t>(half * CELL)], CELL,
                    per_sigma);
      }
    }
  }

  /// Drops planes that no point of the block can take in any optimal labelling: some other
  /// label is better by more than four changes cost (dead-end elimination).
  void dropHopeless(std::size_t block)
  {
    CandidateBlocks& blocks = field_.blocks;
    const std::size_t count = blocks.count[block];
    const BlockRow::Numbers four =
        units(4 * static_cast<float>(parameters_.label_change)) + BlockRow::Numbers{};
    std::array<BlockRow::Numbers, SIDE> limit;
    for (std::size_t r = 0; r < SIDE; ++r) {
      limit[r] = costs_[r][0];
      for (std::size_t s = 1; s < count; ++s)
        limit[r] = least(limit[r], costs_[r][s]);
      limit[r] += four;
    }
    std::size_t kept = 1;
    for (std::size_t s = 1; s < count; ++s) {
      BlockRow::Numbers hope = {};
      for (std::size_t r = 0; r < SIDE; ++r)
        hope |= (costs_[r][s] <= limit[r]) & valid_[r];
      if (!any(hope))
        continue;
      for (std::size_t r = 0; r < SIDE; ++r)
        costs_[r][kept] = costs_[r][s];
      blocks.labels[block * SLOTS + kept] = blocks.labels[block * SLOTS + s];
      ++kept;
    }
    blocks.count[block] = static_cast<std::uint8_t>(kept);
  }

  static bool any(BlockRow::Numbers numbers)
  {
    using Words __attribute__((vector_size(16))) = std::uint64_t;
    const auto words = reinterpret_cast<Words>(numbers);
    return (words[0] | words[1]) != 0;
  }

  /// The label that is best at some point: no other can be best everywhere.
  std::size_t bestSomewhere(std::size_t count) const
  {
    for (std::size_t r = 0; r < SIDE; ++r)
      for (std::size_t k = 0; k < SIDE; ++k) {
        if (valid_[r][k] == 0)
          continue;
        std::size_t best = count > 1 ? 1 : 0;
        for (std::size_t s = 2; s < count; ++s)
          best = costs_[r][s][k] < costs_[r][best][k] ? s : best;
        return costs_[r][0][k] + margin() <= costs_[r][best][k] ? 0 : best;
      }
    return 0;
  }

  std::int16_t margin() const
  {
    return units(0.5f * static_cast<float>(parameters_.label_change));
  }

  /// A label that is better than all others everywhere by half the price of a change: in a
  /// block of 8x8 points no other labelling saves more at the borders of the block, where
  /// neighbours may carry any labels, than that. For "no plane" in place of a plane it is
  /// enough that no hole pays.
  bool isSettled(std::size_t label, std::size_t count) const
  {
    const BlockRow::Numbers ahead = margin() + BlockRow::Numbers{};
    for (std::size_t s = label == 0 ? 0 : 1; s < count; ++s) {
      if (s == label)
        continue;
      BlockRow::Numbers better = {};
      for (std::size_t r = 0; r < SIDE; ++r)
        better |= (costs_[r][label] + ahead > costs_[r][s]) & valid_[r];
      if (any(better))
        return false;
    }
    return label == 0 || squaresOf(label) <= mostSquares();
  }

  /// Sum of the squared costs of a label, sigmas; costs that were cut are far too many.
  double squaresOf(std::size_t label) const
  {
    float sum = 0;
    for (const auto& row : costs_)
      for (std::size_t k = 0; k < SIDE; ++k) {
        const auto cost = static_cast<float>(row[label][k]);
        sum += cost * cost;
      }
    return sum / (units_ * units_);
  }

  void fillWeights(const BlockPlace& place, BlockWeights& out)
  {
    const double range = rangeOf(place.block);
    per_step_ = static_cast<float>(
        1.0 / (parameters_.step_sigmas * noise_.small(range) + STEP_SHARE * range));
    const auto width = static_cast<std::size_t>(field_.width);
    const bool right_edge = place.column + place.columns == field_.width;
    for (int r = 0; r < place.rows; ++r) {
      const std::size_t i = pointAt(place, r);
      const auto row = static_cast<std::size_t>(r);
      out.right[row] = edges(i, i + 1, place.columns - (right_edge ? 1 : 0));
      if (place.row + r + 1 < field_.height)
        out.down[row] = edges(i, i + width, place.columns);
      if (place.column > 0)
        out.left.v[row] = edges(i - 1, i, 1).v[0];
    }
    if (place.row > 0) {
      const std::size_t i = pointAt(place, 0);
      out.above = edges(i - width, i, place.columns);
    }
  }

  double rangeOf(std::size_t block) const
  {
    const TileSums& sums = block_sums_[block];
    return sums.n > 0 ? sums.centroid().norm() : 1.0;
  }

  /// Potts weights that fall with the depth step, down to a share of themselves: between
  /// points i and j and those that follow them.
  BlockRow edges(std::size_t i, std::size_t j, int count) const
  {
    std::int16_t weight[SIDE] = {};
    if (count == SIDE) // known to the compiler: no loop is left
      fillEdges(i, j, SIDE, weight);
    else
      fillEdges(i, j, static_cast<std::size_t>(count), weight);
    return {gather(weight)};
  }

  void fillEdges(std::size_t i, std::size_t j, std::size_t count,
                 std::int16_t* weight) const
  {
    const auto least = static_cast<float>(parameters_.min_weight);
    const float price = static_cast<float>(parameters_.label_change) * units_;
    for (std::size_t k = 0; k < count; ++k) {
      const float step = (depth_[i + k] - depth_[j + k]) * per_step_;
      const float falling = 1.0f / (1.0f + step * step);
      const float share = falling > least ? falling : least;
      const int edge = points_.valid[i + k] & points_.valid[j + k];
      weight[k] = static_cast<std::int16_t>(
          static_cast<std::int32_t>(price * share + 0.5f) & -edge);
    }
  }

  std::int16_t units(float cost) const
  {
    return static_cast<std::int16_t>(std::lrint(cost * units_));
  }

  static constexpr int ROUNDING = 5;  ///< terms of a sum, each rounded up at worst
  static constexpr float MOST = 3.0f; ///< cut of the data cost over "no plane"'s
  static constexpr double STEP_SHARE = 0.01; ///< of the range: a slope, not a step

  const OrganizedPoints& points_;
  const TileLevel& cells_;
  const std::vector<TileSums>& block_sums_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  CandidateField& field_;
  std::vector<LabelScale> scales_;
  std::vector<float> ranges_;
  const float* depth_ = nullptr;
  float units_ = 1.0f; ///< in one sigma
  float per_step_ = 0.0f;
  std::array<std::array<float, SIDE>, SLOTS> per_sigma_ = {};
  // of the block at hand
  PointRow points_row_;
  std::array<std::array<BlockRow::Numbers, SLOTS>, SIDE> costs_;
  std::array<BlockRow::Numbers, SIDE> valid_;
};

} // namespace

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  CandidateField field;
  field.width = points.width;
  field.height = points.height;
  field.blocks = findCandidates(regions, pyramid[0], field.width, field.height,
                                parameters.support_reach);
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
