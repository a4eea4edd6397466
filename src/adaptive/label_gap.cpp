// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/label_gap.h"

#include "adaptive/block_costs.h"
#include "adaptive/block_noise.h"
#include "adaptive/candidate_field.h"
#include "adaptive/edge_weights.h"
#include "adaptive/label_gap_kernel.h"
#include "adaptive/label_scale.h"
#include "adaptive/noise_estimation.h"
#include "adaptive/plane_evidence.h"
#include "adaptive/tile_pyramid.h"
#include "frame_memory.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;
constexpr std::size_t SLOTS = CandidateBlocks::SLOTS;
constexpr int REACH = 2; ///< of a label from the cells that have it, cells

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

/// Region of the first labelled point of a cell, or -1.
int firstRegion(const std::uint16_t* labels, std::size_t width, std::size_t columns,
                std::size_t rows)
{
  for (std::size_t row = 0; row < rows; ++row, labels += width) {
    std::uint64_t all = 0;
    std::memcpy(&all, labels, columns * sizeof(*labels));
    for (std::size_t k = 0; all != 0 && k < columns; ++k)
      if (labels[k] != 0)
        return labels[k] - 1;
  }
  return -1;
}

/// That of each cell: enough to say what is near.
FrameVector<int> cellRegions(const TileLevel& cells, const OrganizedPoints& points,
                             const std::vector<std::uint16_t>& labels)
{
  FrameVector<int> regions;
  regions.reserve(cells.at(0, cells.rows));
  const auto width = static_cast<std::size_t>(points.width);
  const auto height = static_cast<std::size_t>(points.height);
  for (std::size_t y = 0; y < height; y += CELL) {
    const std::size_t rows = std::min<std::size_t>(CELL, height - y);
    const std::uint16_t* row = &labels[y * width];
    std::size_t x = 0;
    for (; x + CELL <= width; x += CELL)
      regions.push_back(firstRegion(row + x, width, CELL, rows));
    if (x < width)
      regions.push_back(firstRegion(row + x, width, width - x, rows));
  }
  return regions;
}

/// The noise of the blocks of a field, found as the segmentation finds it.
std::shared_ptr<const BlockNoise> findBlockNoise(const OrganizedPoints& points,
                                                 const Parameters& parameters)
{
  const AdaptiveParameters& adaptive = parameters.adaptive;
  std::vector<TileLevel> pyramid = buildTilePyramid(points, adaptive);
  const NoiseLaw noise = adaptive.estimate_noise
                             ? estimateNoise(pyramid, adaptive)
                             : statedNoise(parameters.noise, pyramid, adaptive);
  assignLocalNoise(pyramid, noise, adaptive);
  const auto found = std::make_shared<BlockNoise>();
  found->assign(noise, pyramid[BLOCK_LEVEL]);
  return found;
}

/// The cells of an image, without sums.
TileLevel emptyCells(const OrganizedPoints& points)
{
  TileLevel cells;
  cells.side = CELL;
  cells.columns = (points.width + CELL - 1) / CELL;
  cells.rows = (points.height + CELL - 1) / CELL;
  return cells;
}

/// Gives each plane the mean noise of the cells that it has.
void spreadNoise(const TileLevel& cells, const BlockNoise& noise, TileRegions& regions)
{
  const auto columns = static_cast<std::size_t>((cells.columns + 1) / 2); // of blocks
  std::vector<double> count(regions.planes.size(), 0);
  for (int row = 0; row < cells.rows; ++row)
    for (int column = 0; column < cells.columns; ++column)
      if (const int region = regions.cell_region[cells.at(column, row)]; region >= 0) {
        const std::size_t block = static_cast<std::size_t>(row / 2) * columns +
                                  static_cast<std::size_t>(column / 2);
        const auto k = static_cast<std::size_t>(region);
        regions.planes[k].noise += noise.blocks[block].variance();
        ++count[k];
      }
  for (std::size_t k = 0; k < count.size(); ++k)
    regions.planes[k].noise /= std::max(count[k], 1.0);
}

/// Labels of a row, and one that no point has on either side of it.
class LabelRow {
public:
  explicit LabelRow(std::size_t width)
  : labels_(1 + (width + SIDE - 1) / SIDE * SIDE + 1, OUTSIDE)
  {}

  void fill(const std::uint16_t* labels, std::size_t width)
  {
    std::copy_n(labels, width, labels_.begin() + 1);
  }
  void clear() { std::fill(labels_.begin(), labels_.end(), OUTSIDE); }
  const std::uint16_t* at(std::size_t x) const { return &labels_[1 + x]; }

private:
  static constexpr std::uint16_t OUTSIDE = 65535; // more than a cloud can have planes
  std::vector<std::uint16_t> labels_;
};

/// Costs of the random field around final labels.
class GapFinder {
public:
  GapFinder(const OrganizedPoints& points, const PlaneSegmentation& result,
            const Parameters& parameters)
  : points_(points)
  , labels_(result.labels)
  , parameters_(parameters.adaptive)
  , costs_{static_cast<float>(parameters.adaptive.none_cost),
           BlockCosts::MOST * static_cast<float>(parameters.adaptive.none_cost)}
  , width_(static_cast<std::size_t>(points.width))
  , noise_(result.block_noise ? result.block_noise : findBlockNoise(points, parameters))
  , label_rows_(3, LabelRow(width_))
  {
    for (const PlaneRegion& region : result.regions)
      regions_.planes.push_back(fittedPlane(region));
    const TileLevel cells = emptyCells(points);
    regions_.cell_region = cellRegions(cells, points, labels_);
    spreadNoise(cells, *noise_, regions_);
    for (const FittedPlane& plane : regions_.planes)
      scales_.push_back(labelScale(plane, noise_->noise, parameters_));
    blocks_ = findCandidates(regions_, cells, points.width, points.height, REACH);
    const std::size_t padded = static_cast<std::size_t>(blocks_.columns) * SIDE;
    per_step_.resize(padded);
    right_.assign(1 + padded, 0.0f); // the first: to the left of the image
    above_.assign(padded, 0.0f);
    below_.assign(padded, 0.0f);
    candidates_.resize(static_cast<std::size_t>(blocks_.columns) * SLOTS);
  }

  std::vector<float> find()
  {
    std::vector<float> gaps(points_.size());
    label_rows_[1].fill(labels_.data(), width_);
    for (int y = 0; y < points_.height; ++y) {
      if (y % SIDE == 0)
        for (int column = 0; column < blocks_.columns; ++column)
          prepare(column, y / SIDE);
      weigh(y);
      if (y + 1 < points_.height)
        label_rows_[2].fill(&labels_[static_cast<std::size_t>(y + 1) * width_], width_);
      else
        label_rows_[2].clear();
      for (std::size_t x = 0; x < width_; x += SIDE)
        findInRow(x, y, gaps);
      std::rotate(label_rows_.begin(), label_rows_.begin() + 1, label_rows_.end());
      std::swap(above_, below_);
    }
    return gaps;
  }

  /// Of each plane.
  std::vector<double> evidence() const
  {
    const double correlated = pointsPerIndependentOne(noise_->noise);
    std::vector<double> out;
    out.reserve(regions_.planes.size());
    for (const FittedPlane& plane : regions_.planes)
      out.push_back(evidenceOf(plane) / correlated);
    return out;
  }

private:
  /// What all points of a block share.
  void prepare(int column, int row)
  {
    const std::size_t block = blocks_.at(column, row);
    const BlockNoise::Block& of_block = noise_->blocks[block];
    const double variance = of_block.variance();
    const auto at = static_cast<std::size_t>(column);
    std::fill_n(&per_step_[at * SIDE], SIDE,
                perStep(noise_->noise, parameters_, of_block.range()));
    for (std::size_t s = 0; s < blocks_.count[block]; ++s)
      candidates_[at * SLOTS + s] = candidate(blocks_.labelsOf(block)[s], variance);
  }

  GapCandidate candidate(std::uint16_t label, double variance) const
  {
    if (label == 0)
      return {};
    const LabelScale& p = scales_[label - 1U];
    const double allowed = p.growth * variance + p.bend;
    return {label, p.a, p.b, p.c, p.d, static_cast<float>(1.0 / std::sqrt(allowed))};
  }

  /// Prices of changes to the right of and below the points of a row.
  void weigh(int y)
  {
    const EdgePrices prices = {static_cast<float>(parameters_.label_change),
                               static_cast<float>(parameters_.min_weight)};
    const float* here = points_.depthRow(y, depth_[0]);
    const std::uint8_t* valid = &points_.valid[static_cast<std::size_t>(y) * width_];
    edgePriceRow(prices, here, here + 1, valid, valid + 1, per_step_.data(), width_ - 1,
                 &right_[1]);
    if (y + 1 < points_.height)
      edgePriceRow(prices, here, points_.depthRow(y + 1, depth_[1]), valid,
                   valid + width_, per_step_.data(), width_, below_.data());
    else
      std::fill(below_.begin(), below_.end(), 0.0f);
  }

  /// Points of one row of a block.
  void findInRow(std::size_t x, int y, std::vector<float>& gaps) const
  {
    const std::size_t i = static_cast<std::size_t>(y) * width_ + x;
    const std::size_t column = x / SIDE;
    GapRow row = {&points_.x[i],        &points_.y[i],        &points_.z[i],
                  label_rows_[1].at(x), label_rows_[0].at(x), label_rows_[2].at(x),
                  &right_[1 + x],       &above_[x],           &below_[x]};
    const GapCandidate* candidates = &candidates_[column * SLOTS];
    const std::size_t count =
        blocks_.count[blocks_.at(static_cast<int>(column), y / SIDE)];
    if (x + SIDE <= width_) {
      gapsOfEight(costs_, row, candidates, count, &gaps[i]);
      return;
    }
    const std::size_t left = width_ - x;
    float padded[4][SIDE] = {};
    std::copy_n(row.x, left, padded[0]);
    std::copy_n(row.y, left, padded[1]);
    std::copy_n(row.z, left, padded[2]);
    row.x = padded[0];
    row.y = padded[1];
    row.z = padded[2];
    gapsOfEight(costs_, row, candidates, count, padded[3]);
    std::copy_n(padded[3], left, &gaps[i]);
  }

  const OrganizedPoints& points_;
  const std::vector<std::uint16_t>& labels_;
  const AdaptiveParameters& parameters_;
  GapCosts costs_;
  std::size_t width_;
  std::shared_ptr<const BlockNoise> noise_;
  TileRegions regions_;
  FrameVector<LabelScale> scales_;
  CandidateBlocks blocks_;
  // of the row of blocks, and the row of points, at hand; as wide as whole blocks
  std::vector<float> per_step_;
  std::vector<GapCandidate> candidates_; ///< SLOTS a block
  std::vector<float> right_, above_, below_;
  std::vector<LabelRow> label_rows_; ///< above, here, below
  std::vector<float> depth_[2];
};

} // namespace

LabelGaps labelGaps(const OrganizedPoints& points, const PlaneSegmentation& result,
                    const Parameters& parameters)
{
  GapFinder finder(points, result, parameters);
  return {finder.find(), finder.evidence()};
}

} // namespace pcl_mrf_planes::adaptive
