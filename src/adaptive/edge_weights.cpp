// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/edge_weights.h"

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
    if (place.column > 0)
      out.left.v[row] = edge(i - 1, i);
  }
  if (place.row > 0) {
    const std::size_t i = place.pointAt(0, width);
    out.above = edges(i - static_cast<std::size_t>(width), i, place.columns);
  }
}

inline std::int16_t EdgeWeights::edge(std::size_t i, std::size_t j) const
{
  const auto least = static_cast<float>(parameters_.min_weight);
  const float step = (depth_[i] - depth_[j]) * per_step_;
  const float share = priceShare(step, least);
  const int is_edge = points_.valid[i] & points_.valid[j];
  return static_cast<std::int16_t>(nearest(price_ * share) & -is_edge);
}

/// Between points i and j and those that follow them.
BlockRow EdgeWeights::edges(std::size_t i, std::size_t j, int count) const
{
  std::int16_t weight[SIDE] = {};
  if (count == SIDE) // known to the compiler: no loop is left
    fillEdges(i, j, SIDE, weight);
  else
    fillEdges(i, j, static_cast<std::size_t>(count), weight);
  return {gather(weight)};
}

inline void EdgeWeights::fillEdges(std::size_t i, std::size_t j, std::size_t count,
                                   std::int16_t* weight) const
{
  for (std::size_t k = 0; k < count; ++k)
    weight[k] = edge(i + k, j + k);
}

} // namespace pcl_mrf_planes::adaptive
