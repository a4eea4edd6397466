// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/cell_labelling.h"
#include "adaptive/label_scale.h"
#include "frame_memory.h"
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
      const int end = strips.begin(strip + 1);
      for (int c = strips.begin(strip); c < end; c += GROUP)
        if (!isCalm(c, end, row))
          for (int k = c; k < std::min(c + GROUP, end); ++k)
            visit(k, row);
    });
    staggeredSteps(strips.count, cells_.rows, threads, [&](int step_strip, int step) {
      const int strip = strips.count - 1 - step_strip;
      const int row = cells_.rows - 1 - step;
      const int begin = strips.begin(strip);
      for (int end = strips.begin(strip + 1); end > begin; end -= GROUP)
        // A group that reaches into the strip beside it is not looked at: others write there.
        if (end - GROUP < begin || !isCalm(end - GROUP, end, row))
          for (int k = end - 1; k >= std::max(end - GROUP, begin); --k)
            visit(k, row);
    });
  }

  const FrameVector<int>& labels() const { return labels_; }

private:
  static constexpr std::size_t SIDES = 4;
  static constexpr int GROUP = 8; ///< cells that are looked at at once
  using Neighbours = std::array<int, SIDES>;

  /// Whether a group of cells from a column on and all their neighbours carry one label:
  /// none of them would get another. \param[in] end of the cells that may be visited
  bool isCalm(int column, int end, int row) const
  {
    if (column < 1 || column + GROUP > end || column + GROUP >= cells_.columns ||
        row < 1 || row + 1 >= cells_.rows)
      return false;
    const int* own = &labels_[cells_.at(column, row)];
    const int* above = own - cells_.columns;
    const int* below = own + cells_.columns;
    const int label = own[0];
    int differ = (own[-1] ^ label) | (own[GROUP] ^ label);
    for (int k = 0; k < GROUP; ++k)
      differ |= (own[k] ^ label) | (above[k] ^ label) | (below[k] ^ label);
    return differ == 0;
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
  FrameVector<LabelScale> scales_;
  FrameVector<int> labels_;
};

/// Adds up the cells of each label; blocks of one label as a whole.
class CellSums {
public:
  CellSums(const std::vector<TileLevel>& pyramid, const FrameVector<int>& labels,
           std::size_t count)
  : sums(count)
  , cells_(pyramid[0])
  , blocks_(pyramid[BLOCK_LEVEL])
  , labels_(labels)
  {}

  void addBlocks(int row)
  {
    for (int c = 0; c < blocks_.columns; ++c)
      if (const int label = labels_[cells_.at(2 * c, 2 * row)]; !isOf(label, c, row))
        addCells(c, row);
      else if (label >= 0)
        sums[static_cast<std::size_t>(label)] += blocks_.sums[blocks_.at(c, row)];
  }

  CellSums& operator+=(const CellSums& other)
  {
    addTo(sums, other.sums);
    return *this;
  }

  FrameVector<TileSums> sums;

private:
  /// Whether a block has four cells of this label.
  bool isOf(int label, int column, int row) const
  {
    if (2 * column + 1 >= cells_.columns || 2 * row + 1 >= cells_.rows)
      return false;
    const int* above = &labels_[cells_.at(2 * column, 2 * row)];
    const int* below = above + cells_.columns;
    return above[1] == label && below[0] == label && below[1] == label;
  }

  void addCells(int column, int row)
  {
    for (int r = 2 * row; r < std::min(2 * row + 2, cells_.rows); ++r)
      for (int c = 2 * column; c < std::min(2 * column + 2, cells_.columns); ++c)
        if (const int label = labels_[cells_.at(c, r)]; label >= 0)
          sums[static_cast<std::size_t>(label)] += cells_.sums[cells_.at(c, r)];
  }

  const TileLevel& cells_;
  const TileLevel& blocks_;
  const FrameVector<int>& labels_;
};

FrameVector<TileSums> sumLabels(const std::vector<TileLevel>& pyramid,
                                const FrameVector<int>& labels, std::size_t count,
                                unsigned int threads)
{
  return sumOfBands(pyramid[BLOCK_LEVEL].rows, threads,
                    CellSums(pyramid, labels, count),
                    [](int first, int last, CellSums& sums) {
                      for (int row = first; row < last; ++row)
                        sums.addBlocks(row);
                    })
      .sums;
}

} // namespace

TileRegions labelCells(const TileRegions& regions,
                       const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                       const AdaptiveParameters& parameters, unsigned int threads)
{
  CellField field(regions, pyramid[0], noise, parameters);
  field.sweep(threads);

  const FrameVector<TileSums> sums =
      sumLabels(pyramid, field.labels(), regions.planes.size(), threads);
  FrameVector<FittedPlane> planes(sums.size());
  fitPlanes(sums.data(), sums.size(), planes.data());
  TileRegions out;
  out.reserve(sums.size());
  FrameVector<int> id(sums.size(), NONE);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (!isPlane(planes[k], 0.5 * parameters.min_points, noise, parameters))
      continue;
    id[k] = static_cast<int>(out.planes.size());
    out.add(planes[k], sums[k]);
  }
  out.cell_region.resize(field.labels().size());
  parallelRows(pyramid[0].rows, threads, [&](int row) {
    for (std::size_t cell = pyramid[0].at(0, row); cell < pyramid[0].at(0, row + 1);
         ++cell) {
      const int label = field.labels()[cell];
      out.cell_region[cell] = label < 0 ? NONE : id[static_cast<std::size_t>(label)];
    }
  });
  return out;
}

} // namespace pcl_mrf_planes::adaptive
