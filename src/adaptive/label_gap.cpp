// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/label_gap.h"

#include "adaptive/block_costs.h"
#include "adaptive/candidate_field.h"
#include "adaptive/edge_weights.h"
#include "adaptive/label_scale.h"
#include "adaptive/noise_estimation.h"
#include "adaptive/tile_pyramid.h"
#include "label_runs.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
constexpr int REACH = 2; ///< of a label from the cells that have it, cells
constexpr std::size_t BLOCK_LEVEL = 1; ///< tiles that are the blocks

/// What the field knows of a plane, from its region.
FittedPlane fittedPlane(const PlaneRegion& region)
{
  FittedPlane out;
  static_cast<Plane&>(out) = region.plane;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(region.covariance,
                                                            Eigen::EigenvaluesOnly);
  out.mse = region.rms * region.rms;
  out.extent = std::sqrt(std::max(axes.eigenvalues()[2], 0.0));
  out.width = std::sqrt(std::max(axes.eigenvalues()[1], 0.0));
  out.n = static_cast<double>(region.indices.size());
  out.centroid = region.centroid;
  return out;
}

/// Region of the first labelled point of each cell, or -1: enough to say what is near.
std::vector<int> cellRegions(const TileLevel& cells, const OrganizedPoints& points,
                             const std::vector<std::uint16_t>& labels)
{
  std::vector<int> regions(cells.sums.size(), -1);
  const auto width = static_cast<std::size_t>(points.width);
  for (int y = 0; y < points.height; ++y) {
    const std::uint16_t* row = &labels[static_cast<std::size_t>(y) * width];
    int* cell = &regions[cells.at(0, y / CELL)];
    for (std::size_t x = 0; x < width; x += CELL, ++cell)
      for (std::size_t k = x; k < std::min(x + CELL, width) && *cell < 0; ++k)
        if (row[k] != 0)
          *cell = row[k] - 1;
  }
  return regions;
}

/// A label that may be had in a block, and how its data cost is computed.
struct Candidate {
  std::uint16_t label;
  float a, b, c, d; ///< of its plane
  float per_sigma;
};

/// Costs of the random field around final labels.
class GapFinder {
public:
  GapFinder(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions,
            const std::vector<std::uint16_t>& labels, const Parameters& parameters)
  : points_(points)
  , labels_(labels)
  , parameters_(parameters.adaptive)
  , none_(static_cast<float>(parameters.adaptive.none_cost))
  , width_(static_cast<std::size_t>(points.width))
  , pyramid_(buildTilePyramid(points, parameters_))
  , noise_(parameters_.estimate_noise
               ? estimateNoise(pyramid_, parameters_)
               : statedNoise(parameters.noise, pyramid_, parameters_))
  , right_(width_, 0.0f)
  , above_(width_, 0.0f)
  , below_(width_, 0.0f)
  {
    assignLocalNoise(pyramid_, noise_, parameters_);
    for (const PlaneRegion& region : regions) {
      regions_.planes.push_back(fittedPlane(region));
      scales_.push_back(labelScale(regions_.planes.back(), noise_, parameters_));
    }
    regions_.cell_region = cellRegions(pyramid_[0], points, labels);
    blocks_ = findCandidates(regions_, pyramid_[0], points.width, points.height, REACH);
    per_step_.resize(width_);
    candidates_.resize(static_cast<std::size_t>(blocks_.columns) * SLOTS);
  }

  std::vector<float> find()
  {
    std::vector<float> gaps(points_.size(), 0.0f);
    for (int y = 0; y < points_.height; ++y) {
      if (y % SIDE == 0)
        for (int column = 0; column < blocks_.columns; ++column)
          prepare(column, y / SIDE);
      weigh(y);
      for (std::size_t x = 0; x < width_; x += SIDE)
        findInRow(x, y, gaps);
      std::swap(above_, below_);
    }
    return gaps;
  }

private:
  /// What all points of a block share.
  void prepare(int column, int row)
  {
    const std::size_t block = blocks_.at(column, row);
    const TileSums& sums = pyramid_[BLOCK_LEVEL].sums[block];
    const double range = sums.n > 0 ? sums.centroid().norm() : 1.0;
    const double variance = sums.n > 0 ? sums.noise / sums.n : 1.0;
    const auto at = static_cast<std::size_t>(column);
    std::fill_n(&per_step_[at * SIDE], std::min<std::size_t>(SIDE, width_ - at * SIDE),
                perStep(noise_, parameters_, range));
    for (std::size_t s = 0; s < blocks_.count[block]; ++s)
      candidates_[at * SLOTS + s] = candidate(blocks_.labelsOf(block)[s], variance);
  }

  Candidate candidate(std::uint16_t label, double variance) const
  {
    if (label == 0)
      return {0, 0, 0, 0, 0, 0};
    const LabelScale& p = scales_[label - 1U];
    const double allowed = p.growth * variance + p.bend;
    return {label, p.a, p.b, p.c, p.d, static_cast<float>(1.0 / std::sqrt(allowed))};
  }

  /// Prices of changes to the right of and below the points of a row.
  void weigh(int y)
  {
    const float* here = points_.depthRow(y, depth_[0]);
    const std::uint8_t* valid = &points_.valid[static_cast<std::size_t>(y) * width_];
    weigh(here, here + 1, valid, valid + 1, width_ - 1, right_.data());
    if (y + 1 < points_.height)
      weigh(here, points_.depthRow(y + 1, depth_[1]), valid, valid + width_, width_,
            below_.data());
    else
      std::fill(below_.begin(), below_.end(), 0.0f);
  }

  void weigh(const float* a, const float* b, const std::uint8_t* a_valid,
             const std::uint8_t* b_valid, std::size_t count, float* out) const
  {
    const auto least = static_cast<float>(parameters_.min_weight);
    const auto price = static_cast<float>(parameters_.label_change);
    const float* per_step = per_step_.data();
    for (std::size_t x = 0; x < count; ++x) {
      const float step = (a[x] - b[x]) * per_step[x];
      out[x] =
          price * priceShare(step, least) * static_cast<float>(a_valid[x] & b_valid[x]);
    }
  }

  /// Data cost, equation (7) in sigmas.
  float data(std::size_t i, const Candidate& c) const
  {
    const float distance =
        std::abs(c.a * points_.x[i] + c.b * points_.y[i] + c.c * points_.z[i] + c.d);
    return c.label == 0 ? none_
                        : std::min(distance * c.per_sigma, BlockCosts::MOST * none_);
  }

  /// Points of one row of a block.
  void findInRow(std::size_t x, int y, std::vector<float>& gaps) const
  {
    const std::size_t i = static_cast<std::size_t>(y) * width_ + x;
    if (allAgree(x, y, i)) {
      findInside(x, y, i, &gaps[i]);
      return;
    }
    const std::size_t count = std::min<std::size_t>(SIDE, width_ - x);
    for (std::size_t k = 0; k < count; ++k)
      if (points_.valid[i + k] != 0)
        gaps[i + k] = gapAt(x + k, y, i + k);
  }

  /// Whether the points of a whole row of a block and all their neighbours, none of them
  /// outside the image, have one label.
  bool allAgree(std::size_t x, int y, std::size_t i) const
  {
    return x > 0 && x + SIDE < width_ && y > 0 && y + 1 < points_.height &&
           labels_[i - 1] == labels_[i] && labels_[i + SIDE] == labels_[i] &&
           isAll(labels_[i], i) && isAll(labels_[i], i - width_) &&
           isAll(labels_[i], i + width_);
  }

  bool isAll(std::uint16_t label, std::size_t i) const
  {
    return findOther(label, labels_.data(), i, i + SIDE) == i + SIDE;
  }

  /// data() of eight points.
  void rowData(std::size_t i, const Candidate& c, float* cost) const
  {
    if (c.label == 0) {
      std::fill_n(cost, SIDE, none_);
      return;
    }
    const float* x = &points_.x[i];
    const float* y = &points_.y[i];
    const float* z = &points_.z[i];
    const float most = BlockCosts::MOST * none_;
    for (std::size_t k = 0; k < SIDE; ++k) {
      const float sigmas =
          std::abs(c.a * x[k] + c.b * y[k] + c.c * z[k] + c.d) * c.per_sigma;
      cost[k] = sigmas < most ? sigmas : most;
    }
  }

  /// The same as gapAt() where allAgree(), for eight points at once: no other label saves
  /// anything.
  void findInside(std::size_t x, int y, std::size_t i, float* gaps) const
  {
    const std::uint16_t mine = labels_[i];
    const Candidate* candidates = &candidates_[x / SIDE * SLOTS];
    const std::size_t count =
        blocks_.count[blocks_.at(static_cast<int>(x) / SIDE, y / SIDE)];
    float own[SIDE];
    float least[SIDE];
    std::fill_n(own, SIDE, mine == 0 ? none_ : BlockCosts::MOST * none_);
    std::fill_n(least, SIDE, mine == 0 ? none_ : std::numeric_limits<float>::max());
    for (std::size_t s = 0; s < count; ++s) {
      float cost[SIDE];
      rowData(i, candidates[s], cost);
      if (candidates[s].label == mine)
        std::copy_n(cost, SIDE, own);
      else
        for (std::size_t k = 0; k < SIDE; ++k)
          least[k] = cost[k] < least[k] ? cost[k] : least[k];
    }
    for (std::size_t k = 0; k < SIDE; ++k) {
      const float gap = least[k] - own[k] + right_[x + k - 1] + right_[x + k] +
                        above_[x + k] + below_[x + k];
      gaps[k] = gap > 0.0f ? gap : 0.0f;
    }
  }

  float gapAt(std::size_t x, int y, std::size_t i) const
  {
    const std::uint16_t mine = labels_[i];
    // A neighbour outside the image has weight 0, and the label of the point itself.
    const float weights[] = {x > 0 ? right_[x - 1] : 0.0f,
                             x + 1 < width_ ? right_[x] : 0.0f, above_[x], below_[x]};
    const std::uint16_t others[] = {
        x > 0 ? labels_[i - 1] : mine, x + 1 < width_ ? labels_[i + 1] : mine,
        y > 0 ? labels_[i - width_] : mine,
        y + 1 < points_.height ? labels_[i + width_] : mine};
    // What a label saves where a neighbour has it as well.
    const auto saved = [&](std::uint16_t label) {
      float sum = 0.0f;
      for (std::size_t k = 0; k < 4; ++k)
        sum += others[k] == label ? weights[k] : 0.0f;
      return sum;
    };
    const Candidate* candidates = &candidates_[x / SIDE * SLOTS];
    const std::size_t count =
        blocks_.count[blocks_.at(static_cast<int>(x) / SIDE, y / SIDE)];
    // "No plane" stands beside a plane that was not found and fits no better.
    float own = mine == 0 ? none_ - saved(0) : BlockCosts::MOST * none_;
    float least = mine == 0 ? none_ : std::numeric_limits<float>::max();
    for (std::size_t s = 0; s < count; ++s) {
      const float cost = data(i, candidates[s]) - saved(candidates[s].label);
      if (candidates[s].label == mine)
        own = cost;
      else
        least = std::min(least, cost);
    }
    return std::max(0.0f, least - own);
  }

  const OrganizedPoints& points_;
  const std::vector<std::uint16_t>& labels_;
  const AdaptiveParameters& parameters_;
  float none_;
  std::size_t width_;
  std::vector<TileLevel> pyramid_;
  NoiseLaw noise_;
  TileRegions regions_;
  std::vector<LabelScale> scales_;
  CandidateBlocks blocks_;
  // of the row of blocks, and the row of points, at hand
  std::vector<float> per_step_;
  std::vector<Candidate> candidates_; ///< SLOTS a block
  std::vector<float> right_, above_, below_;
  std::vector<float> depth_[2];
};

} // namespace

std::vector<float> labelGaps(const OrganizedPoints& points,
                             const std::vector<PlaneRegion>& regions,
                             const std::vector<std::uint16_t>& labels,
                             const Parameters& parameters)
{
  return GapFinder(points, regions, labels, parameters).find();
}

} // namespace pcl_mrf_planes::adaptive
