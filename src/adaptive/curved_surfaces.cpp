// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/curved_surfaces.h"
#include "adaptive/plane_evidence.h"
#include "adaptive/surface_bend.h"
#include "frame_memory.h"
#include "threads.h"

#include <boost/container/flat_map.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;

/// Where two regions meet.
struct Border {
  int length = 0; ///< points
  double step =
      0; ///< sum of squared distances across, the smaller one of both ways, m^2
};

/// Borders by the regions on either side, the smaller number first.
using Borders =
    boost::container::flat_map<std::pair<int, int>, Border, std::less<>,
                               FrameAllocator<std::pair<std::pair<int, int>, Border>>>;

/// Looks across every change of label, at points so far apart that the smoothing of edges by
/// the sensor does not count.
class BorderFinder {
public:
  BorderFinder(const OrganizedPoints& points, const FittedRegions& regions,
               const std::vector<std::uint16_t>& labels, double sharpest_crease)
  : goes_on(regions.planes.size(), 0)
  , points_(points)
  , regions_(regions)
  , labels_(labels)
  , sine_(std::sin(sharpest_crease))
  {}

  /// Looks across the borders of some rows' runs, half open.
  void look(const LabelRuns& image, int first_row, int last_row)
  {
    const std::size_t width = image.width;
    const std::size_t last = image.rows[static_cast<std::size_t>(last_row)];
    for (std::size_t r = image.rows[static_cast<std::size_t>(first_row)]; r < last;
         ++r) {
      const LabelRun& run = image.runs[r];
      if (run.label == 0)
        continue;
      const std::size_t row_end = (run.begin / width + 1) * width;
      if (run.end - 1 + REACH < row_end)
        look(run.label, run.end - 1, run.end - 1 + REACH);
      if (row_end + (REACH - 1) * width >= labels_.size())
        continue;
      const std::uint16_t* below = labels_.data() + width;
      for (std::size_t i = run.begin;
           (i = findOther(run.label, below, i, run.end)) < run.end; ++i)
        look(run.label, i, i + REACH * width);
    }
  }

  BorderFinder& operator+=(const BorderFinder& other)
  {
    for (const auto& [pair, border] : other.borders) {
      borders[pair].length += border.length;
      borders[pair].step += border.step;
    }
    for (std::size_t k = 0; k < goes_on.size(); ++k)
      goes_on[k] += other.goes_on[k];
    return *this;
  }

  Borders borders;
  /// Border points of each region beyond which the surface goes on in a shallow crease, but
  /// is on no plane.
  FrameVector<int> goes_on;

private:
  static constexpr std::size_t REACH = 3;

  void look(std::uint16_t label, std::size_t i, std::size_t j)
  {
    if (label == labels_[j] || points_.valid[j] == 0)
      return;
    const double across = distance(label - 1, j);
    if (labels_[j] == 0) {
      goes_on[label - 1U] += isShallow(across, i, j) ? 1 : 0;
      return;
    }
    const std::pair<int, int> pair = std::minmax(label - 1, labels_[j] - 1);
    if (border_ == nullptr || pair != pair_) { // mostly the same as the last time
      pair_ = pair;
      border_ = &borders[pair];
    }
    const double back = distance(labels_[j] - 1, i);
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
  const std::vector<std::uint16_t>& labels_;
  double sine_;
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
FrameVector<int> fanSizes(const Borders& borders, const FittedRegions& regions,
                          double largest, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  FrameVector<std::size_t> parent(regions.planes.size());
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
  FrameVector<int> members(parent.size(), 0);
  for (std::size_t k = 0; k < parent.size(); ++k)
    ++members[find(k)];
  FrameVector<int> sizes(parent.size());
  for (std::size_t k = 0; k < parent.size(); ++k)
    sizes[k] = members[find(k)];
  return sizes;
}

/// Whether there is so much of a plane that chance does not explain it.
bool isEvident(const FittedPlane& plane, const AdaptiveParameters& parameters)
{
  return evidenceOf(plane) >= parameters.min_evidence;
}

/// Which regions are parts of a curved surface.
class CurvedSurfaces {
public:
  CurvedSurfaces(const OrganizedPoints& points, const LabelledPoints& image,
                 const NoiseLaw& noise, const AdaptiveParameters& parameters,
                 const FittedRegions& regions, unsigned int threads)
  : parameters_(parameters)
  , regions_(regions)
  , largest_(parameters.fan_share * static_cast<double>(points.countValid()))
  , bends_(measureBends(points, image.runs, regions.planes, threads))
  {
    BorderFinder finder = sumOfBands(
        points.height, threads,
        BorderFinder(points, regions, image.labels, parameters.fan_angle * DEGREE),
        [&](int first, int last, BorderFinder& found) {
          found.look(image.runs, first, last);
        });
    fan_ = fanSizes(finder.borders, regions, largest_, noise, parameters);
    wide_fan_ = fanSizes(finder.borders, regions, WIDE * largest_, noise, parameters);
    goes_on_ = std::move(finder.goes_on);
  }

  bool has(std::size_t region) const
  {
    return bendsItself(bends_[region]) ||
           (parameters_.fan_parts > 0 && (fan_[region] >= parameters_.fan_parts ||
                                          isFacet(region) || isWideFacet(region)));
  }

private:
  /// A turn counts for as much as the bend stands out of the noise: for all of it where
  /// the quadric explains everything, for a third where that is a tenth of the variance.
  static double clearTurn(const Bend& bend)
  {
    return bend.angle * std::sqrt(bend.share);
  }

  bool bendsItself(const Bend& bend) const
  {
    return clearTurn(bend) > parameters_.bend_angle * DEGREE;
  }

  /// Larger facets, if there is one more of them in the row and they bend a little
  /// themselves: those of a prism do not.
  bool isWideFacet(std::size_t region) const
  {
    constexpr double A_LITTLE = 2.0 * DEGREE;
    return wide_fan_[region] > parameters_.fan_parts &&
           clearTurn(bends_[region]) > A_LITTLE;
  }

  /// What is left of a fan whose other parts were no planes.
  bool isFacet(std::size_t region) const
  {
    const double n = regions_.planes[region].n;
    return n <= largest_ && goes_on_[region] >= parameters_.fan_border * std::sqrt(n);
  }

  const AdaptiveParameters& parameters_;
  const FittedRegions& regions_;
  static constexpr double WIDE = 3.0; ///< points of a larger facet over those of one
  double largest_;                    ///< points of a facet
  FrameVector<Bend> bends_;
  FrameVector<int> fan_;
  FrameVector<int> wide_fan_;
  FrameVector<int> goes_on_;
};

} // namespace

void dropDoubtfulPlanes(const OrganizedPoints& points, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, FittedRegions& regions,
                        LabelledPoints& image, unsigned int threads)
{
  const CurvedSurfaces curved(points, image, noise, parameters, regions, threads);
  FrameVector<std::uint16_t> id(regions.planes.size() + 1, 0);
  FittedRegions kept;
  for (std::size_t k = 0; k < regions.planes.size(); ++k)
    if (!curved.has(k) && isEvident(regions.planes[k], parameters)) {
      kept.add(regions.planes[k], regions.sums[k]);
      id[k + 1] = static_cast<std::uint16_t>(kept.planes.size());
    }
  image.renumber(id, threads);
  regions = std::move(kept);
}

} // namespace pcl_mrf_planes::adaptive
