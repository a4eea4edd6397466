// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_refinement.h"
#include "frame_memory.h"
#include "label_runs.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Labels of 4-connected parts below the least size become 0.
void dropSmallParts(int least, LabelledPoints& image, unsigned int threads)
{
  LabelRuns& runs = image.runs;
  const RunRoots roots(runs, threads);
  forEachRun(runs, threads, [&](std::size_t k) {
    if (roots.points(k) < least) {
      fillRun(runs.runs[k], 0, image.labels);
      runs.runs[k].label = 0;
    }
  });
}

/// Sums of the points of each label; blocks and cells that are of one label as a whole are
/// added at once.
class LabelSums {
public:
  LabelSums(const OrganizedPoints& points, const std::vector<TileLevel>& pyramid,
            const std::vector<std::uint16_t>& labels, std::size_t count)
  : sums(count)
  , points_(points)
  , cells_(pyramid[0])
  , blocks_(pyramid[BLOCK_LEVEL])
  , labels_(labels)
  {}

  void addBlocks(int row)
  {
    for (int c = 0; c < blocks_.columns; ++c) {
      const TileSums& block = blocks_.sums[blocks_.at(c, row)];
      if (block.n < 1)
        continue;
      if (isWhole<BLOCK>(c, row))
        sums[labels_[firstPoint(c * BLOCK, row * BLOCK)]] += block;
      else
        addCells(c, row);
    }
  }

  LabelSums& operator+=(const LabelSums& other)
  {
    addTo(sums, other.sums);
    return *this;
  }

  FrameVector<TileSums> sums;

private:
  static constexpr int BLOCK = 2 * CELL; ///< side, points

  void addCells(int block_column, int block_row)
  {
    for (int r = 2 * block_row; r < std::min(2 * block_row + 2, cells_.rows); ++r)
      for (int c = 2 * block_column; c < std::min(2 * block_column + 2, cells_.columns);
           ++c) {
        const TileSums& cell = cells_.sums[cells_.at(c, r)];
        if (cell.n < 1)
          continue;
        if (isWhole<CELL>(c, r))
          sums[labels_[firstPoint(c * CELL, r * CELL)]] += cell;
        else
          addPoints(c, r, cell.noise / cell.n);
      }
  }

  std::size_t firstPoint(int u, int v) const
  {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(points_.width) +
           static_cast<std::size_t>(u);
  }

  /// All points of one label: four points of a row are one word.
  template <int SIDE>
  bool isWhole(int column, int row) const
  {
    constexpr std::uint64_t FOUR_TIMES = 0x0001000100010001U;
    if ((column + 1) * SIDE > points_.width || (row + 1) * SIDE > points_.height)
      return false;
    std::size_t i = firstPoint(column * SIDE, row * SIDE);
    const std::uint64_t all = FOUR_TIMES * labels_[i];
    std::uint64_t differ = 0;
    for (int v = 0; v < SIDE; ++v, i += static_cast<std::size_t>(points_.width))
      for (std::size_t u = 0; u < SIDE; u += 4) {
        std::uint64_t word = 0;
        std::memcpy(&word, &labels_[i + u], sizeof(word));
        differ |= word ^ all;
      }
    return differ == 0;
  }

  void addPoints(int column, int row, double noise)
  {
    const int bottom = std::min((row + 1) * CELL, points_.height);
    const int right = std::min((column + 1) * CELL, points_.width);
    for (int v = row * CELL; v < bottom; ++v)
      for (int u = column * CELL; u < right; ++u) {
        const std::size_t i = firstPoint(u, v);
        if (labels_[i] == 0)
          continue;
        TileSums& sum = sums[labels_[i]];
        sum.add(points_.x[i], points_.y[i], points_.z[i]);
        sum.noise += noise;
      }
  }

  const OrganizedPoints& points_;
  const TileLevel& cells_;
  const TileLevel& blocks_;
  const std::vector<std::uint16_t>& labels_;
};

FrameVector<TileSums> sumLabels(const OrganizedPoints& points,
                                const std::vector<TileLevel>& pyramid,
                                const std::vector<std::uint16_t>& labels,
                                std::size_t count, unsigned int threads)
{
  return sumOfBands(pyramid[BLOCK_LEVEL].rows, threads,
                    LabelSums(points, pyramid, labels, count),
                    [](int first, int last, LabelSums& sums) {
                      for (int row = first; row < last; ++row)
                        sums.addBlocks(row);
                    })
      .sums;
}

/// The sums of the points of a label that lie no farther from a plane than that.
TileSums sumNear(const OrganizedPoints& points, const LabelRuns& image,
                 std::uint16_t label, const FittedPlane& plane, double farthest)
{
  TileSums sums;
  for (const LabelRun& run : image.runs) {
    if (run.label != label)
      continue;
    for (std::size_t i = run.begin; i < run.end; ++i)
      if (points.valid[i] != 0 &&
          std::abs(plane.distance(points.x[i], points.y[i], points.z[i])) <= farthest)
        sums.add(points.x[i], points.y[i], points.z[i]);
  }
  return sums;
}

/// Planes fitted to the points of labels.
class Refit {
public:
  Refit(const OrganizedPoints& points, const LabelRuns& image,
        const FittedRegions& before, const NoiseLaw& noise,
        const AdaptiveParameters& parameters)
  : points_(points)
  , image_(image)
  , before_(before)
  , noise_(noise)
  , parameters_(parameters)
  {}

  /// \param[in,out] sums, plane of the points of a label
  /// \return whether all of them, or all but a few, are a plane; those few are then taken out
  bool fit(std::uint16_t label, TileSums& sums, FittedPlane& plane) const
  {
    if (isPlane(plane, parameters_.min_points, noise_, parameters_))
      return true;
    if (plane.n < parameters_.min_points)
      return false;
    // Single points of what stands in front have the label of what is around them. Without
    // noise, two of them at half a metre weigh more than a floor.
    const FittedPlane& known = before_.planes[label - 1U];
    const double sigma = std::sqrt(allowedVariance(known, noise_, parameters_));
    TileSums near =
        sumNear(points_, image_, label, known, parameters_.none_cost * sigma);
    if (near.n < LEAST * sums.n)
      return false;
    near.noise = sums.noise * near.n / sums.n;
    sums = near;
    plane = fitSums(sums);
    return isPlane(plane, parameters_.min_points, noise_, parameters_);
  }

private:
  static constexpr double LEAST = 0.99; ///< of the points

  const OrganizedPoints& points_;
  const LabelRuns& image_;
  const FittedRegions& before_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
};

} // namespace

LabelledPoints::LabelledPoints(std::vector<std::uint16_t> of_points, int width,
                               unsigned int threads)
: labels(std::move(of_points))
, runs(findRuns(labels, width, 0, threads))
{
  std::uint16_t most = 0;
  for (const LabelRun& run : runs.runs)
    most = std::max(most, run.label);
  number_.resize(most + std::size_t{1});
  std::iota(number_.begin(), number_.end(), std::uint16_t{0});
}

void LabelledPoints::renumber(const FrameVector<std::uint16_t>& id,
                              unsigned int threads)
{
  forEachRun(runs, threads, [&](std::size_t k) {
    LabelRun& run = runs.runs[k];
    if (id[run.label] == 0 && run.label != 0)
      fillRun(run, 0, labels);
    run.label = id[run.label];
  });
  for (std::uint16_t& number : number_)
    number = id[number];
}

void LabelledPoints::write(unsigned int threads)
{
  forEachRun(runs, threads, [&](std::size_t k) {
    const LabelRun& run = runs.runs[k];
    if (labels[run.begin] != run.label)
      fillRun(run, run.label, labels);
  });
  std::iota(number_.begin(), number_.end(), std::uint16_t{0});
}

FittedRegions refineRegions(const OrganizedPoints& points,
                            const std::vector<TileLevel>& pyramid,
                            const FittedRegions& before, const NoiseLaw& noise,
                            const AdaptiveParameters& parameters, LabelledPoints& image,
                            unsigned int threads)
{
  dropSmallParts(parameters.min_points, image, threads);
  const std::size_t count = before.planes.size() + 1;
  FrameVector<TileSums> sums = sumLabels(points, pyramid, image.labels, count, threads);
  const Refit refit(points, image.runs, before, noise, parameters);
  FrameVector<FittedPlane> planes(count);
  fitPlanes(sums.data(), count, planes.data());
  FittedRegions out;
  out.reserve(count);
  FrameVector<std::uint16_t> id(count, 0);
  for (std::size_t k = 1; k < count; ++k) {
    if (!refit.fit(static_cast<std::uint16_t>(k), sums[k], planes[k]))
      continue;
    out.add(planes[k], sums[k]);
    id[k] = static_cast<std::uint16_t>(out.planes.size());
  }
  image.renumber(id, threads);
  return out;
}

} // namespace pcl_mrf_planes::adaptive
