// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_borders.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Finds the borders of a part of an image.
class BorderFinder {
public:
  BorderFinder(const OrganizedPoints& points, const FittedRegions& regions,
               const LabelledPoints& image, double sharpest_crease)
  : points_(points)
  , regions_(regions)
  , image_(image)
  , sine_(std::sin(sharpest_crease))
  {
    found.open.assign(regions.planes.size(), 0);
    found.goes_on.assign(regions.planes.size(), 0);
  }

  /// Looks across the borders of some rows' runs, half open.
  void look(int first_row, int last_row)
  {
    const LabelRuns& runs = image_.runs;
    const std::vector<std::uint16_t>& labels = image_.labels;
    const std::size_t width = runs.width;
    const std::size_t last = runs.rows[static_cast<std::size_t>(last_row)];
    for (std::size_t r = runs.rows[static_cast<std::size_t>(first_row)]; r < last;
         ++r) {
      const LabelRun& run = runs.runs[r];
      if (run.label == 0)
        continue;
      const std::size_t row_end = (run.begin / width + 1) * width;
      if (run.end - 1 + REACH < row_end)
        look(run.label, run.end - 1, run.end - 1 + REACH);
      if (row_end + (REACH - 1) * width >= labels.size())
        continue;
      const std::uint16_t name = labels[run.begin];
      const std::uint16_t* below = labels.data() + width;
      for (std::size_t i = run.begin;
           (i = findOther(name, below, i, run.end)) < run.end; ++i)
        look(run.label, i, i + REACH * width);
    }
  }

  BorderFinder& operator+=(const BorderFinder& other)
  {
    found += other.found;
    return *this;
  }

  RegionBorders found;

private:
  static constexpr std::size_t REACH = 3;

  void look(std::uint16_t label, std::size_t i, std::size_t j)
  {
    const std::uint16_t other = image_.at(j);
    if (label == other || points_.valid[j] == 0)
      return;
    const double across = distance(label - 1, j);
    if (other == 0) {
      ++found.open[label - 1U];
      found.goes_on[label - 1U] += isShallow(across, i, j) ? 1 : 0;
      return;
    }
    const std::pair<int, int> pair = std::minmax(label - 1, other - 1);
    if (border_ == nullptr || pair != pair_) { // mostly the same as the last time
      pair_ = pair;
      border_ = &found.between[pair];
    }
    const double back = distance(other - 1, i);
    ++border_->length;
    border_->step += std::min(across * across, back * back);
  }

  /// Whether the surface goes on to a point in a crease no sharper than that of a fan.
  bool isShallow(double height, std::size_t i, std::size_t j) const
  {
    const Eigen::Vector3d way(points_.x[j] - points_.x[i], points_.y[j] - points_.y[i],
                              points_.z[j] - points_.z[i]);
    return height * height <= sine_ * sine_ * way.squaredNorm();
  }

  double distance(int region, std::size_t i) const
  {
    return regions_.planes[static_cast<std::size_t>(region)].distance(
        points_.x[i], points_.y[i], points_.z[i]);
  }

  const OrganizedPoints& points_;
  const FittedRegions& regions_;
  const LabelledPoints& image_;
  double sine_;
  std::pair<int, int> pair_ = {-1, -1};
  Border* border_ = nullptr;
};

} // namespace

RegionBorders& RegionBorders::operator+=(const RegionBorders& other)
{
  for (const auto& [pair, border] : other.between) {
    between[pair].length += border.length;
    between[pair].step += border.step;
  }
  addTo(open, other.open);
  addTo(goes_on, other.goes_on);
  return *this;
}

RegionBorders findBorders(const OrganizedPoints& points, const FittedRegions& regions,
                          const LabelledPoints& image, double sharpest_crease,
                          unsigned int threads)
{
  return sumOfBands(points.height, threads,
                    BorderFinder(points, regions, image, sharpest_crease),
                    [](int first, int last, BorderFinder& finder) {
                      finder.look(first, last);
                    })
      .found;
}

} // namespace pcl_mrf_planes::adaptive
