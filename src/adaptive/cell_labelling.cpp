// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/cell_labelling.h"
#include "adaptive/label_scale.h"
#include "threads.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr int NONE = -1;
constexpr int OUTSIDE = -2; // of the image: no edge

/// The field of the cells and its labels.
class CellField {
public:
  CellField(const TileRegions& regions, const TileLevel& cells, const NoiseLaw& noise,
            const AdaptiveParameters& parameters)
  : cells_(cells)
  , none_(parameters.none_cost)
  , change_(CELL * parameters.label_change)
  , labels_(regions.cell_region)
  {
    for (const FittedPlane& plane : regions.planes)
      scales_.push_back(labelScale(plane, noise, parameters));
  }

  /// One front goes down and one up, in different halves of the image at any time.
  void sweep(unsigned int threads)
  {
    const int middle = cells_.rows / 2;
    for (const bool down_is_below : {false, true}) {
      seeAcross(middle);
      parallelParts(2, threads, [&](int half) {
        const bool is_below = half == 1;
        const int top = is_below ? middle : 0;
        const int bottom = is_below ? cells_.rows : middle;
        if (is_below == down_is_below)
          sweepDown(top, bottom);
        else
          sweepUp(top, bottom);
      });
    }
  }

  const std::vector<int>& labels() const { return labels_; }

private:
  static constexpr std::size_t SIDES = 4;
  using Neighbours = std::array<int, SIDES>;

  /// Each half sees the other's nearest row as it is now.
  void seeAcross(int middle)
  {
    middle_ = middle;
    const auto copy = [&](int row, std::vector<int>& to) {
      if (row >= 0 && row < cells_.rows)
        to.assign(labels_.begin() + static_cast<std::ptrdiff_t>(cells_.at(0, row)),
                  labels_.begin() + static_cast<std::ptrdiff_t>(cells_.at(0, row + 1)));
    };
    copy(middle - 1, last_above_);
    copy(middle, first_below_);
  }

  void sweepDown(int top, int bottom)
  {
    for (int r = top; r < bottom; ++r)
      for (int c = 0; c < cells_.columns; ++c)
        visit(c, r);
  }

  void sweepUp(int top, int bottom)
  {
    for (int r = bottom - 1; r >= top; --r)
      for (int c = cells_.columns - 1; c >= 0; --c)
        visit(c, r);
  }

  /// Gives a cell the label of least energy among its own and its neighbours'.
  void visit(int column, int row)
  {
    const std::size_t cell = cells_.at(column, row);
    const Neighbours beside = neighbours(column, row);
    const int own = labels_[cell];
    if (std::all_of(beside.begin(), beside.end(),
                    [own](int label) { return label == own || label == OUTSIDE; }))
      return;
    const TileSums& sums = cells_.sums[cell];
    double least = sums.n * none_ + changes(beside, NONE);
    labels_[cell] = NONE;
    const auto consider = [&](int label) {
      if (label < 0 || label == labels_[cell] || sums.n < 1)
        return;
      const double energy = dataCost(sums, label) + changes(beside, label);
      if (energy < least) {
        least = energy;
        labels_[cell] = label;
      }
    };
    consider(own);
    for (std::size_t k = 0; k < SIDES; ++k)
      if (beside[k] != own && (k == 0 || beside[k] != beside[k - 1]))
        consider(beside[k]);
  }

  Neighbours neighbours(int column, int row) const
  {
    const auto label = [&](int c, int r) { return labels_[cells_.at(c, r)]; };
    const auto c = static_cast<std::size_t>(column);
    const auto above = [&] {
      return row == middle_ ? last_above_[c] : label(column, row - 1);
    };
    const auto below = [&] {
      return row + 1 == middle_ ? first_below_[c] : label(column, row + 1);
    };
    return {column > 0 ? label(column - 1, row) : OUTSIDE, row > 0 ? above() : OUTSIDE,
            column + 1 < cells_.columns ? label(column + 1, row) : OUTSIDE,
            row + 1 < cells_.rows ? below() : OUTSIDE};
  }

  double changes(const Neighbours& beside, int label) const
  {
    int different = 0;
    for (const int other : beside)
      different +=
          static_cast<int>(other != label) & static_cast<int>(other != OUTSIDE);
    return change_ * different;
  }

  /// Equation (7) in sigmas for all points of a cell, by their root mean square distance.
  double dataCost(const TileSums& sums, int label) const
  {
    const LabelScale& plane = scales_[static_cast<std::size_t>(label)];
    const double variance = plane.growth * (sums.noise / sums.n) + plane.bend;
    return std::sqrt(std::max(0.0, squaredDistances(sums, plane)) * sums.n / variance);
  }

  const TileLevel& cells_;
  double none_;
  double change_; ///< price of a change along a side of a cell
  std::vector<LabelScale> scales_;
  std::vector<int> labels_;
  int middle_ = 0;               ///< first row of the lower half
  std::vector<int> last_above_;  ///< labels of the row above it, as the lower half sees it
  std::vector<int> first_below_; ///< its own labels, as the upper half sees them
};

/// Sums of the cells of each label, band by band of the image.
std::vector<TileSums> sumLabels(const TileLevel& cells, const std::vector<int>& labels,
                                std::size_t count, unsigned int threads)
{
  const Bands bands(cells.rows, 4);
  std::vector<std::vector<TileSums>> sums(static_cast<std::size_t>(bands.count));
  parallelParts(bands.count, threads, [&](int band) {
    std::vector<TileSums>& of_band = sums[static_cast<std::size_t>(band)];
    of_band.resize(count);
    for (std::size_t i = cells.at(0, bands.begin(band));
         i < cells.at(0, bands.begin(band + 1)); ++i)
      if (labels[i] >= 0)
        of_band[static_cast<std::size_t>(labels[i])] += cells.sums[i];
  });
  for (std::size_t band = 1; band < sums.size(); ++band)
    for (std::size_t k = 0; k < count; ++k)
      sums[0][k] += sums[band][k];
  return std::move(sums[0]);
}

} // namespace

TileRegions labelCells(const TileRegions& regions, const TileLevel& cells,
                       const NoiseLaw& noise, const AdaptiveParameters& parameters,
                       unsigned int threads)
{
  CellField field(regions, cells, noise, parameters);
  field.sweep(threads);

  const std::vector<TileSums> sums =
      sumLabels(cells, field.labels(), regions.planes.size(), threads);
  TileRegions out;
  std::vector<int> id(sums.size(), NONE);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    const FittedPlane plane = fitSums(sums[k]);
    if (!isPlane(plane, 0.5 * parameters.min_points, noise, parameters))
      continue;
    id[k] = static_cast<int>(out.planes.size());
    out.planes.push_back(plane);
    out.sums.push_back(sums[k]);
  }
  out.cell_region.reserve(cells.sums.size());
  for (const int label : field.labels())
    out.cell_region.push_back(label < 0 ? NONE : id[static_cast<std::size_t>(label)]);
  return out;
}

} // namespace pcl_mrf_planes::adaptive
