// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/block_costs.h"
#include "adaptive/lanes.h"
#include "frame_memory.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pcl_mrf_planes::adaptive {

namespace {

bool any(BlockRow::Numbers numbers)
{
  using Words __attribute__((vector_size(16))) = std::uint64_t;
  const auto words = reinterpret_cast<Words>(numbers);
  return (words[0] | words[1]) != 0;
}

} // namespace

BlockCosts::BlockCosts(const OrganizedPoints& points,
                       const FrameVector<LabelScale>& scales, const TileLevel& cells,
                       const AdaptiveParameters& parameters, CostUnits units)
: points_(points)
, cells_(cells)
, parameters_(parameters)
, units_(units)
, scales_(scales)
{}

// Its k points save their distances less k times the cost of "no plane", at most
// sqrt(k) sqrt(Q) - k none where Q is the sum of squared distances in sigmas; they pay for
// a border of at least 4 sqrt(k). That is never worth it while
// sqrt(Q) <= none + 4 change. Q follows from the ten sums of the block.
bool BlockCosts::fitAsAWhole(const TileSums& sums, std::uint16_t label) const
{
  const LabelScale& plane = scales_[label - 1U];
  return squaredDistances(sums, plane) * sums.n <=
         mostSquares() * (plane.growth * sums.noise + plane.bend * sums.n);
}

double BlockCosts::mostSquares() const
{
  const double most = parameters_.none_cost + 4 * parameters_.label_change;
  return most * most;
}

void BlockCosts::fill(const BlockPlace& place, const std::uint16_t* labels,
                      std::size_t count)
{
  const std::int16_t none = units_(static_cast<float>(parameters_.none_cost));
  for (int r = 0; r < SIDE; ++r) {
    const auto row = static_cast<std::size_t>(r);
    if (r < place.rows)
      loadRow(place.pointAt(r, points_.width), place.columns);
    else
      row_ = {};
    if (r % CELL == 0 && r < place.rows)
      lookUpNoise(place, place.row + r, labels, count);
    valid_[row] = maskOf(loadBytes(row_.valid));
    costs_[row][0] = none & valid_[row];
    for (std::size_t s = 1; s < count; ++s)
      costs_[row][s] = costs(scales_[labels[s] - 1U], per_sigma_[s]) & valid_[row];
  }
}

inline void BlockCosts::copyPoints(std::size_t i, std::size_t count)
{
  // A copy that may overlap would be a call.
  std::memcpy(row_.x, &points_.x[i], count * sizeof(float));
  std::memcpy(row_.y, &points_.y[i], count * sizeof(float));
  std::memcpy(row_.z, &points_.z[i], count * sizeof(float));
  std::memcpy(row_.valid, &points_.valid[i], count);
}

inline void BlockCosts::loadRow(std::size_t i, int count)
{
  if (count == SIDE) { // known to the compiler: no loop is left
    copyPoints(i, SIDE);
    return;
  }
  row_ = {};
  copyPoints(i, static_cast<std::size_t>(count));
}

/// Noise is known by cell: looks up what all points of a row share.
void BlockCosts::lookUpNoise(const BlockPlace& place, int row,
                             const std::uint16_t* labels, std::size_t count)
{
  for (int half = 0; half < SIDE / CELL; ++half) {
    const int column = std::min(place.column / CELL + half, cells_.columns - 1);
    const TileSums& sums = cells_.sums[cells_.at(column, row / CELL)];
    const auto variance = static_cast<float>(sums.n > 0 ? sums.noise / sums.n : 1.0);
    for (std::size_t s = 1; s < count; ++s) {
      const LabelScale& scale = scales_[labels[s] - 1U];
      const float per_sigma =
          1.0f / std::sqrt(static_cast<float>(scale.growth) * variance +
                           static_cast<float>(scale.bend));
      std::fill_n(per_sigma_[s].begin() + half * CELL, CELL, per_sigma);
    }
  }
}

inline BlockRow::Numbers
BlockCosts::costs(const LabelScale& plane,
                  const std::array<float, SIDE>& per_sigma) const
{
  const PointRow& p = row_;
  const float a = plane.a, b = plane.b, c = plane.c, d = plane.d;
  const float most = MOST * static_cast<float>(parameters_.none_cost);
  const float scale = units_.per_sigma;
  const auto four = [&](int k) {
    const Floats distance =
        a * loadFour(p.x + k) + b * loadFour(p.y + k) + c * loadFour(p.z + k) + d;
    const Floats sigmas =
        (distance < 0.0f ? -distance : distance) * loadFour(&per_sigma[0] + k);
    return nearest((sigmas < most ? sigmas : most) * scale);
  };
  return join(four(0), four(LANES));
}

// Some other label is better by more than four changes cost (dead-end elimination).
std::size_t BlockCosts::dropHopeless(std::uint16_t* labels, std::size_t count)
{
  const BlockRow::Numbers four =
      units_(4 * static_cast<float>(parameters_.label_change)) + BlockRow::Numbers{};
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
    labels[kept] = labels[s];
    ++kept;
  }
  return kept;
}

std::size_t BlockCosts::settledLabel(std::size_t count) const
{
  const std::size_t label = bestSomewhere(count);
  return isSettled(label, count) ? label : OPEN;
}

/// The label that is best at some point: no other can be best everywhere.
std::size_t BlockCosts::bestSomewhere(std::size_t count) const
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

std::int16_t BlockCosts::margin() const
{
  return units_(0.5f * static_cast<float>(parameters_.label_change));
}

/// A label that is better than all others everywhere by half the price of a change: in a
/// block of 8x8 points no other labelling saves more at the borders of the block, where
/// neighbours may carry any labels, than that. For "no plane" in place of a plane it is
/// enough that no hole pays: not by the squares of the distances, as in fitAsAWhole(), or not
/// by what all the points far off would save, as one of them pays for two changes more even
/// on the side of a hole that is there already.
bool BlockCosts::isSettled(std::size_t label, std::size_t count) const
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
  return label == 0 || squaresOf(label) <= mostSquares() ||
         excessOf(label) <= 2 * static_cast<float>(parameters_.label_change);
}

/// What the points of the block save at most that leave a plane for "no plane", sigmas.
float BlockCosts::excessOf(std::size_t label) const
{
  float sum = 0;
  for (const auto& row : costs_)
    for (std::size_t k = 0; k < SIDE; ++k)
      sum += static_cast<float>(std::max(row[label][k] - row[0][k], 0));
  return sum / units_.per_sigma;
}

/// Sum of the squared costs of a label, sigmas.
float BlockCosts::squaresOf(std::size_t label) const
{
  float sum = 0;
  for (const auto& row : costs_)
    for (std::size_t k = 0; k < SIDE; ++k) {
      const auto cost = static_cast<float>(row[label][k]);
      sum += cost * cost;
    }
  return sum / (units_.per_sigma * units_.per_sigma);
}

} // namespace pcl_mrf_planes::adaptive
