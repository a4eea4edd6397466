// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_refinement.h"
#include "adaptive/surface_bend.h"
#include "label_runs.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

void fillRun(const LabelRun& run, std::uint16_t label,
             std::vector<std::uint16_t>& labels)
{
  std::fill(labels.begin() + static_cast<std::ptrdiff_t>(run.begin),
            labels.begin() + static_cast<std::ptrdiff_t>(run.end), label);
}

/// Labels of 4-connected parts below the least size become 0.
LabelRuns dropSmallParts(int width, int least, std::vector<std::uint16_t>& labels)
{
  LabelRuns image = findRuns(labels, width, 0);
  const RunParts parts = connectRuns(image);
  for (std::size_t k = 0; k < image.runs.size(); ++k)
    if (parts.size[static_cast<std::size_t>(parts.part_of_run[k])] < least) {
      fillRun(image.runs[k], 0, labels);
      image.runs[k].label = 0;
    }
  return image;
}

/// Gives every label its new number.
void renumber(const LabelRuns& image, const std::vector<std::uint16_t>& id,
              std::vector<std::uint16_t>& labels)
{
  for (const LabelRun& run : image.runs)
    if (id[run.label] != run.label)
      fillRun(run, id[run.label], labels);
}

/// Sums of the points of each label; whole cells of one label are added at once.
class LabelSums {
public:
  LabelSums(const OrganizedPoints& points, const TileLevel& cells,
            const std::vector<std::uint16_t>& labels, std::size_t count)
  : sums(count)
  , majority(cells.sums.size(), 0)
  , points_(points)
  , labels_(labels)
  {
    for (int r = 0; r < cells.rows; ++r)
      for (int c = 0; c < cells.columns; ++c) {
        const std::size_t cell = cells.at(c, r);
        if (cells.sums[cell].n < 1)
          continue;
        if (isWhole(c, r)) {
          majority[cell] = labels[firstPoint(c, r)];
          sums[majority[cell]] += cells.sums[cell];
        }
        else
          majority[cell] = addPoints(c, r, cells.sums[cell].noise / cells.sums[cell].n);
      }
  }

  std::vector<TileSums> sums;
  std::vector<std::uint16_t> majority; ///< label of most points of each cell

private:
  std::size_t firstPoint(int column, int row) const
  {
    return static_cast<std::size_t>(row * CELL) *
               static_cast<std::size_t>(points_.width) +
           static_cast<std::size_t>(column * CELL);
  }

  /// All points of one label: a row of a cell is one word.
  bool isWhole(int column, int row) const
  {
    constexpr std::uint64_t FOUR_TIMES = 0x0001000100010001U;
    if ((column + 1) * CELL > points_.width || (row + 1) * CELL > points_.height)
      return false;
    std::size_t i = firstPoint(column, row);
    const std::uint64_t all = FOUR_TIMES * labels_[i];
    std::uint64_t differ = 0;
    for (int v = 0; v < CELL; ++v, i += static_cast<std::size_t>(points_.width)) {
      std::uint64_t word = 0;
      std::memcpy(&word, &labels_[i], sizeof(word));
      differ |= word ^ all;
    }
    return differ == 0;
  }

  /// Adds point by point. \return the label of most of them
  std::uint16_t addPoints(int column, int row, double noise)
  {
    votes_.clear();
    const int bottom = std::min((row + 1) * CELL, points_.height);
    const int right = std::min((column + 1) * CELL, points_.width);
    for (int v = row * CELL; v < bottom; ++v)
      for (int u = column * CELL; u < right; ++u) {
        const std::size_t i =
            static_cast<std::size_t>(v) * static_cast<std::size_t>(points_.width) +
            static_cast<std::size_t>(u);
        if (labels_[i] == 0)
          continue;
        TileSums& sum = sums[labels_[i]];
        sum.add(points_.x[i], points_.y[i], points_.z[i]);
        sum.noise += noise;
        vote(labels_[i]);
      }
    const auto most =
        std::max_element(votes_.begin(), votes_.end(), [](const auto& a, const auto& b) {
          return a.second != b.second ? a.second < b.second : a.first > b.first;
        });
    return most == votes_.end() ? std::uint16_t{0} : most->first;
  }

  void vote(std::uint16_t label)
  {
    for (auto& [l, n] : votes_)
      if (l == label) {
        ++n;
        return;
      }
    votes_.emplace_back(label, 1);
  }

  const OrganizedPoints& points_;
  const std::vector<std::uint16_t>& labels_;
  std::vector<std::pair<std::uint16_t, int>> votes_;
};

/// Whether points fit a plane as well as their noise allows, and spread so far that it is
/// not the noise which makes them one.
bool isPlane(const FittedPlane& plane, const NoiseLaw& noise,
             const AdaptiveParameters& parameters)
{
  const double tolerance = parameters.accept_tolerance * parameters.accept_tolerance;
  const double width = parameters.min_width * parameters.min_width;
  const double allowed = allowedVariance(plane, noise, parameters);
  return plane.mse <= tolerance * allowed && plane.width * plane.width >= width * allowed;
}

} // namespace

TileRegions refineRegions(const OrganizedPoints& points, const TileLevel& cells,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          std::vector<std::uint16_t>& labels)
{
  const LabelRuns image = dropSmallParts(points.width, parameters.min_points / 4, labels);
  std::size_t count = 1;
  for (const LabelRun& run : image.runs)
    count = std::max<std::size_t>(count, run.label + 1U);
  const LabelSums found(points, cells, labels, count);
  TileRegions out;
  std::vector<std::uint16_t> id(count, 0);
  for (std::size_t k = 1; k < count; ++k) {
    if (found.sums[k].n < parameters.min_points)
      continue;
    const FittedPlane plane = fitSums(found.sums[k]);
    if (!isPlane(plane, noise, parameters))
      continue;
    out.planes.push_back(plane);
    out.sums.push_back(found.sums[k]);
    id[k] = static_cast<std::uint16_t>(out.planes.size());
  }
  renumber(image, id, labels);
  for (const std::uint16_t label : found.majority)
    out.cell_region.push_back(id[label] - 1);
  return out;
}

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;

/// Where two regions meet.
struct Border {
  int length = 0; ///< points
  double step =
      0; ///< sum of squared distances across, the smaller one of both ways, m^2
};

/// Borders by the regions on either side, the smaller number first.
using Borders = std::map<std::pair<int, int>, Border>;

/// Looks across every change of label, at points so far apart that the smoothing of edges by
/// the sensor does not count.
class BorderFinder {
public:
  BorderFinder(const OrganizedPoints& points, const TileRegions& regions,
               const std::vector<std::uint16_t>& labels)
  : points_(points)
  , regions_(regions)
  , labels_(labels)
  {}

  Borders find(const LabelRuns& image)
  {
    const std::size_t width = image.width;
    for (const LabelRun& run : image.runs) {
      const std::size_t row_end = (run.begin / width + 1) * width;
      if (run.end - 1 + REACH < row_end)
        look(run.label, run.end - 1, run.end - 1 + REACH);
      if (row_end + (REACH - 1) * width >= labels_.size())
        continue;
      for (std::size_t i = run.begin; i < run.end; ++i)
        if (labels_[i + width] != run.label)
          look(run.label, i, i + REACH * width);
    }
    return std::move(borders_);
  }

private:
  static constexpr std::size_t REACH = 3;

  void look(std::uint16_t label, std::size_t i, std::size_t j)
  {
    if (labels_[j] == 0 || label == labels_[j] || label == 0)
      return;
    const std::pair<int, int> pair = std::minmax(label - 1, labels_[j] - 1);
    if (border_ == nullptr || pair != pair_) { // mostly the same as the last time
      pair_ = pair;
      border_ = &borders_[pair];
    }
    const double across = distance(label - 1, j);
    const double back = distance(labels_[j] - 1, i);
    ++border_->length;
    border_->step += std::min(across * across, back * back);
  }

  double distance(int region, std::size_t i) const
  {
    return regions_.planes[static_cast<std::size_t>(region)].distance(
        points_.x[i], points_.y[i], points_.z[i]);
  }

  const OrganizedPoints& points_;
  const TileRegions& regions_;
  const std::vector<std::uint16_t>& labels_;
  Borders borders_;
  std::pair<int, int> pair_ = {-1, -1};
  Border* border_ = nullptr;
};

/// True for two smaller regions that meet along a long border, in a shallow crease and
/// without a step: facets of one curved surface.
bool isFold(const FittedPlane& a, const FittedPlane& b, const Border& border,
            double largest, const NoiseLaw& noise, const AdaptiveParameters& parameters)
{
  if (a.n > largest || b.n > largest ||
      a.normal.dot(b.normal) < std::cos(parameters.fan_angle * DEGREE))
    return false;
  if (border.length < parameters.fan_border * std::sqrt(std::min(a.n, b.n)))
    return false;
  constexpr double STEP_SHARE = 0.002; // of the distance: points that lie apart
  const double apart = STEP_SHARE * a.centroid.norm();
  const double allowed = std::max(allowedVariance(a, noise, parameters),
                                  allowedVariance(b, noise, parameters)) +
                         apart * apart;
  return border.step / border.length <=
         parameters.fan_gap * parameters.fan_gap * allowed;
}

/// Number of regions in the row of folds that each region belongs to.
std::vector<int> fanSizes(const Borders& borders, const TileRegions& regions,
                          double largest, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  std::vector<std::size_t> parent(regions.planes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (parent[k] != k)
      k = parent[k];
    return k;
  };
  for (const auto& [pair, border] : borders) {
    const auto a = static_cast<std::size_t>(pair.first);
    const auto b = static_cast<std::size_t>(pair.second);
    if (isFold(regions.planes[a], regions.planes[b], border, largest, noise,
               parameters))
      parent[std::max(find(a), find(b))] = std::min(find(a), find(b));
  }
  std::vector<int> members(parent.size(), 0);
  for (std::size_t k = 0; k < parent.size(); ++k)
    ++members[find(k)];
  std::vector<int> sizes(parent.size());
  for (std::size_t k = 0; k < parent.size(); ++k)
    sizes[k] = members[find(k)];
  return sizes;
}

} // namespace

void dropCurvedFans(const OrganizedPoints& points, const NoiseLaw& noise,
                    const AdaptiveParameters& parameters, TileRegions& regions,
                    std::vector<std::uint16_t>& labels)
{
  const LabelRuns image = findRuns(labels, points.width, 0);
  const double largest =
      parameters.fan_share * static_cast<double>(points.countValid());
  const std::vector<int> fan = fanSizes(BorderFinder(points, regions, labels).find(image),
                                        regions, largest, noise, parameters);
  const std::vector<Bend> bends = measureBends(points, labels, regions.planes);
  const auto curved = [&](const Bend& bend) {
    return bend.angle > parameters.bend_angle * DEGREE &&
           bend.share > parameters.bend_share;
  };
  std::vector<std::uint16_t> id(regions.planes.size() + 1, 0);
  TileRegions kept;
  for (std::size_t k = 0; k < regions.planes.size(); ++k)
    if (fan[k] < parameters.fan_parts && !curved(bends[k])) {
      kept.planes.push_back(regions.planes[k]);
      kept.sums.push_back(regions.sums[k]);
      id[k + 1] = static_cast<std::uint16_t>(kept.planes.size());
    }
  renumber(image, id, labels);
  regions = std::move(kept);
}

} // namespace pcl_mrf_planes::adaptive
