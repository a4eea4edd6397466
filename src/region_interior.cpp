// SPDX-License-Identifier: BSD-3-Clause
#include "region_interior.h"

#include <pcl_mrf_planes/scatter_matrix.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pcl_mrf_planes {

namespace {

using Runs = FrameVector<LabelRun>;

/// Runs of a row, ascending.
struct RowRuns {
  const LabelRun* first;
  const LabelRun* last;
  const LabelRun* begin() const { return first; }
  const LabelRun* end() const { return last; }
};

/// Invalid points between two runs of a label that do not end them.
constexpr std::size_t LARGEST_GAP = 4;

/// The points that runs have in common, label by label; both ascend, and the others are so
/// many points further back in the image.
Runs meet(const Runs& a, const Runs& others, std::size_t back)
{
  Runs out;
  for (std::size_t i = 0, j = 0; i < a.size() && j < others.size();) {
    const LabelRun& other = others[j];
    const std::size_t begin = std::max(a[i].begin, other.begin + back);
    const std::size_t end = std::min(a[i].end, other.end + back);
    if (begin < end && a[i].label == other.label)
      out.push_back({begin, end, a[i].label});
    ++(a[i].end < other.end + back ? i : j);
  }
  return out;
}

/// Takes a point off either end of the runs of a row, but not at the border of the image.
void shrink(std::size_t row_begin, std::size_t row_end, Runs& runs)
{
  for (LabelRun& run : runs) {
    run.begin += run.begin > row_begin ? 1 : 0;
    run.end -= run.end < row_end ? 1 : 0;
  }
  runs.erase(std::remove_if(runs.begin(), runs.end(),
                            [](const LabelRun& run) { return run.begin >= run.end; }),
             runs.end());
}

/// Runs of a row of regions, and what is left of them off the borders.
class InteriorFinder {
public:
  InteriorFinder(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions)
  : points_(points)
  , regions_(regions)
  , image_(regionRuns(regions, points.width, points.height))
  , borders_(regions.size())
  {}

  std::vector<RegionInterior> find()
  {
    std::vector<RegionInterior> out(regions_.size());
    Runs above;
    Runs here = points_.height > 0 ? shrunk(0) : Runs();
    for (int y = 0; y < points_.height; ++y) {
      Runs below = y + 1 < points_.height ? shrunk(y + 1) : Runs();
      const RowRuns own = rowRuns(y);
      Runs inside;
      for (const LabelRun& run : own) // without the gaps
        inside.push_back(run);
      inside = meet(inside, here, 0);
      if (y > 0)
        inside = meet(inside, above, image_.width);
      if (y + 1 < points_.height)
        inside = meet(inside, below, std::size_t{0} - image_.width);
      addBorder(own, inside);
      for (const LabelRun& run : inside)
        out[run.label - 1U].runs.push_back(run);
      above = std::exchange(here, std::move(below));
    }
    for (std::size_t k = 0; k < out.size(); ++k)
      finish(regions_[k], borders_[k], out[k]);
    return out;
  }

private:
  RowRuns rowRuns(int y) const
  {
    const auto row = static_cast<std::size_t>(y);
    const LabelRun* runs = image_.runs.data();
    return {runs + image_.rows[row], runs + image_.rows[row + 1]};
  }

  Runs shrunk(int y) const
  {
    Runs runs;
    for (const LabelRun& run : rowRuns(y))
      if (!runs.empty() && goesOn(runs.back(), run))
        runs.back().end = run.end;
      else
        runs.push_back(run);
    const std::size_t begin = static_cast<std::size_t>(y) * image_.width;
    shrink(begin, begin + image_.width, runs);
    return runs;
  }

  bool goesOn(const LabelRun& a, const LabelRun& b) const
  {
    if (a.label != b.label || b.begin - a.end > LARGEST_GAP)
      return false;
    const auto first = points_.valid.begin();
    return std::all_of(first + static_cast<std::ptrdiff_t>(a.end),
                       first + static_cast<std::ptrdiff_t>(b.begin),
                       [](std::uint8_t valid) { return valid == 0; });
  }

  /// Adds up the points of a row that are not inside, about the centroids of their regions.
  void addBorder(const RowRuns& own, const Runs& inside)
  {
    std::size_t k = 0;
    for (const LabelRun& run : own) {
      std::size_t begin = run.begin;
      for (; k < inside.size() && inside[k].begin < run.end; ++k) {
        addPoints(run.label, begin, inside[k].begin);
        begin = inside[k].end;
      }
      addPoints(run.label, begin, run.end);
    }
  }

  void addPoints(std::uint16_t label, std::size_t begin, std::size_t end)
  {
    const Eigen::Vector3d& c = regions_[label - 1U].centroid;
    for (std::size_t i = begin; i < end; ++i)
      borders_[label - 1U].add(points_.x[i] - c.x(), points_.y[i] - c.y(),
                               points_.z[i] - c.z());
  }

  /// A region less its border, whose sums are about the centroid of the region.
  static void finish(const PlaneRegion& region, const ScatterMatrix& border,
                     RegionInterior& out)
  {
    const auto n = static_cast<double>(region.indices.size());
    out.n = n - border.n;
    if (out.n < 1)
      return;
    Eigen::Matrix3d squares;
    squares << border.xx, border.xy, border.xz, border.xy, border.yy, border.yz,
        border.xz, border.yz, border.zz;
    const Eigen::Vector3d shift =
        -Eigen::Vector3d(border.x, border.y, border.z) / out.n;
    out.centroid = region.centroid + shift;
    out.covariance =
        (n * region.covariance - squares) / out.n - shift * shift.transpose();
  }

  const OrganizedPoints& points_;
  const std::vector<PlaneRegion>& regions_;
  LabelRuns image_;
  std::vector<ScatterMatrix> borders_;
};

} // namespace

std::vector<RegionInterior> regionInteriors(const OrganizedPoints& points,
                                            const std::vector<PlaneRegion>& regions)
{
  return InteriorFinder(points, regions).find();
}

} // namespace pcl_mrf_planes
