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
    scales_.reserve(regions.planes.size());
    for (const FittedPlane& plane : regions.planes)
      scales_.push_back(labelScale(plane, noise, parameters));
  }

  /// Down the image from left to right and up again from right to left, in as many upright
  /// strips as there are threads: as if there were one.
  void sweep(unsigned int threads)
  {
    const Bands strips(cells_.columns, threadCount(threads));
    staggeredSteps(strips.count, cells_.rows, threads, [&](int strip, int row) {
      for (int c = strips.begin(strip); c < strips.begin(strip + 1); ++c)
        visit(c, row);
    });
    staggeredSteps(strips.count, cells_.rows, threads, [&](int step_strip, int step) {
      const int strip = strips.count - 1 - step_strip;
      for (int c = strips.begin(strip + 1) - 1; c >= strips.begin(strip); --c)
        visit(c, cells_.rows - 1 - step);
    });
  }

  const std::vector<int>& labels() const { return labels_; }

private:
  static constexpr std::size_t SIDES = 4;
  using Neighbours = std::array<int, SIDES>;

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
    return {column > 0 ? label(column - 1, row) : OUTSIDE,
            row > 0 ? label(column, row - 1) : OUTSIDE,
            column + 1 < cells_.columns ? label(column + 1, row) : OUTSIDE,
            row + 1 < cells_.rows ? label(column, row + 1) : OUTSIDE};
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
};

/// Sums of the cells of each label.
std::vector<TileSums> sumLabels(const TileLevel& cells, const std::vector<int>& labels,
                                std::size_t count, unsigned int threads)
{
  return sumOfBands(cells.rows, threads, std::vector<TileSums>(count),
                    [&](int first, int last, std::vector<TileSums>& sums) {
                      for (std::size_t i = cells.at(0, first); i < cells.at(0, last);
                           ++i)
                        if (labels[i] >= 0)
                          sums[static_cast<std::size_t>(labels[i])] += cells.sums[i];
                    });
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
