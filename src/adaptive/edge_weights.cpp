// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/edge_weights.h"
#include "adaptive/lanes.h"

#include <algorithm>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;

} // namespace

EdgeWeights::EdgeWeights(const OrganizedPoints& points, const float* depth,
                         const NoiseLaw& noise, const AdaptiveParameters& parameters,
                         CostUnits units)
: points_(points)
, noise_(noise)
, parameters_(parameters)
, price_(static_cast<float>(parameters.label_change) * units.per_sigma)
, depth_(depth)
{}

void EdgeWeights::fill(const BlockPlace& place, double range, BlockWeights& out)
{
  per_step_ = perStep(noise_, parameters_, range);
  const int width = points_.width;
  const bool right_edge = place.column + place.columns == width;
  for (int r = 0; r < place.rows; ++r) {
    const std::size_t i = place.pointAt(r, width);
    const auto row = static_cast<std::size_t>(r);
    out.right[row] = edges(i, i + 1, place.columns - (right_edge ? 1 : 0));
    if (place.row + r + 1 < points_.height)
      out.down[row] = edges(i, i + static_cast<std::size_t>(width), place.columns);
  }
  if (place.column > 0)
    out.left = edgesToTheLeft(place);
  if (place.row > 0) {
    const std::size_t i = place.pointAt(0, width);
    out.above = edges(i - static_cast<std::size_t>(width), i, place.columns);
  }
}

/// Between points i and j and those that follow them.
BlockRow EdgeWeights::edges(std::size_t i, std::size_t j, int count) const
{
  const std::uint8_t* const valid = points_.valid.data();
  if (count == SIDE)
    return {weights({depth_ + i, valid + i}, {depth_ + j, valid + j})};
  float depth[2][SIDE] = {};
  std::uint8_t is_valid[2][SIDE] = {};
  std::copy_n(depth_ + i, count, depth[0]);
  std::copy_n(depth_ + j, count, depth[1]);
  std::copy_n(valid + i, count, is_valid[0]);
  std::copy_n(valid + j, count, is_valid[1]);
  return {weights({depth[0], is_valid[0]}, {depth[1], is_valid[1]})};
}

/// From the first column of a block.
BlockRow EdgeWeights::edgesToTheLeft(const BlockPlace& place) const
{
  float depth[2][SIDE] = {};
  std::uint8_t is_valid[2][SIDE] = {};
  for (int r = 0; r < place.rows; ++r) {
    const std::size_t i = place.pointAt(r, points_.width);
    depth[0][r] = depth_[i - 1];
    depth[1][r] = depth_[i];
    is_valid[0][r] = points_.valid[i - 1];
    is_valid[1][r] = points_.valid[i];
  }
  return {weights({depth[0], is_valid[0]}, {depth[1], is_valid[1]})};
}

/// Between eight points each.
inline BlockRow::Numbers EdgeWeights::weights(const PointRow& from,
                                              const PointRow& to) const
{
  const auto least = static_cast<float>(parameters_.min_weight);
  const auto four = [&](int k) {
    const Floats step = (loadFour(from.depth + k) - loadFour(to.depth + k)) * per_step_;
    return nearest(price_ * priceShare(step, least));
  };
  return join(four(0), four(LANES)) &
         maskOf(loadBytes(from.valid) & loadBytes(to.valid));
}

} // namespace pcl_mrf_planes::adaptive
