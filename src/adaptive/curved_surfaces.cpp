// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/curved_surfaces.h"
#include "adaptive/flatness.h"
#include "adaptive/plane_evidence.h"
#include "adaptive/region_borders.h"
#include "adaptive/surface_bend.h"
#include "adaptive/surrounded_facets.h"
#include "frame_memory.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;

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

/// The folds between regions of at most so many points.
FrameVector<Fold> findFolds(const RegionBorders& borders, const FittedRegions& regions,
                            double largest, const NoiseLaw& noise,
                            const AdaptiveParameters& parameters)
{
  FrameVector<Fold> folds;
  for (const auto& [pair, border] : borders.between) {
    const auto a = static_cast<std::size_t>(pair.first);
    const auto b = static_cast<std::size_t>(pair.second);
    if (isFold(regions.planes[a], regions.planes[b], border, largest, noise,
               parameters))
      folds.push_back({a, b, border.length});
  }
  return folds;
}

/// Number of regions in the row of folds that each region belongs to.
/// \param[in] largest regions of more points are in none
FrameVector<int> fanSizes(const FrameVector<Fold>& folds, const FittedRegions& regions,
                          double largest)
{
  FrameVector<std::size_t> parent(regions.planes.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto find = [&](std::size_t k) {
    while (parent[k] != k)
      k = parent[k];
    return k;
  };
  for (const Fold& fold : folds)
    if (std::max(regions.planes[fold.a].n, regions.planes[fold.b].n) <= largest) {
      const std::size_t a = find(fold.a), b = find(fold.b);
      parent[std::max(a, b)] = std::min(a, b);
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
  , largest_(parameters.fan_share * static_cast<double>(points.countValid(threads)))
  , bends_(measureBends(points, image.runs, regions.planes, threads))
  {
    const RegionBorders borders =
        findBorders(points, regions, image, parameters.fan_angle * DEGREE, threads);
    const FrameVector<Fold> folds =
        findFolds(borders, regions, WIDE * largest_, noise, parameters);
    fan_ = fanSizes(folds, regions, largest_);
    wide_fan_ = fanSizes(folds, regions, WIDE * largest_);
    surrounded_ = findSurroundedFacets(regions, borders, folds, parameters.fan_ring);
    goes_on_ = borders.goes_on;
  }

  bool has(std::size_t region) const
  {
    return bendsItself(region) ||
           (parameters_.fan_parts > 0 &&
            (fan_[region] >= parameters_.fan_parts || isFacet(region) ||
             isWideFacet(region) || surrounded_[region]));
  }

private:
  /// A turn counts for as much as the bend stands out of the noise: for all of it where
  /// the quadric explains everything, for a third where that is a tenth of the variance.
  static double clearTurn(const Bend& bend)
  {
    return bend.angle * std::sqrt(bend.share);
  }

  /// An arc turns by the root of how far it bends: what may bend less for want of noise may
  /// turn less, where next to nothing but the bend keeps its points off the plane.
  bool bendsItself(std::size_t region) const
  {
    constexpr double NEARLY_ALL = 0.9; // of the squared distances
    const Bend& bend = bends_[region];
    const double most = parameters_.bend_angle * DEGREE;
    return clearTurn(bend) > most ||
           (bend.share > NEARLY_ALL &&
            bend.angle >
                most * std::sqrt(flatnessShare(regions_.planes[region], parameters_)));
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
  FrameVector<bool> surrounded_;
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
  kept.reserve(regions.planes.size());
  for (std::size_t k = 0; k < regions.planes.size(); ++k)
    if (!curved.has(k) && isEvident(regions.planes[k], parameters)) {
      kept.add(regions.planes[k], regions.sums[k]);
      id[k + 1] = static_cast<std::uint16_t>(kept.planes.size());
    }
  image.renumber(id, threads);
  regions = std::move(kept);
}

} // namespace pcl_mrf_planes::adaptive
