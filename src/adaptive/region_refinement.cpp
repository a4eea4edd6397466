// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_refinement.h"
#include "adaptive/surface_bend.h"

#include <pcl_mrf_planes/region_contour.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Labels of 4-connected parts below the least size become 0.
void dropSmallParts(const OrganizedPoints& points, int least,
                    std::vector<std::uint16_t>& labels)
{
  const ConnectedParts parts = findConnectedParts(labels, points.width, points.height);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i] != 0 &&
        parts.size[static_cast<std::size_t>(parts.part_of_point[i])] < least)
      labels[i] = 0;
}

/// region of a tile: the label of most of its points
void assignCells(const OrganizedPoints& points, const TileLevel& cells,
                 const std::vector<std::uint16_t>& labels, TileRegions& out)
{
  out.cell_region.assign(cells.sums.size(), -1);
  std::map<int, int> votes;
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      votes.clear();
      for (int v = r * cells.side; v < std::min((r + 1) * cells.side, points.height);
           ++v)
        for (int u = c * cells.side; u < std::min((c + 1) * cells.side, points.width);
             ++u)
          if (const int l = labels[static_cast<std::size_t>(v) *
                                       static_cast<std::size_t>(points.width) +
                                   static_cast<std::size_t>(u)])
            ++votes[l];
      int best = 0;
      for (const auto& [l, n] : votes)
        if (n > best) {
          best = n;
          out.cell_region[cells.at(c, r)] = l - 1;
        }
    }
}

} // namespace

TileRegions refineRegions(const OrganizedPoints& points, const TileLevel& cells,
                          const NoiseLaw& noise, const AdaptiveParameters& parameters,
                          std::vector<std::uint16_t>& labels)
{
  dropSmallParts(points, parameters.min_points / 4, labels);
  const std::size_t count = 1 + *std::max_element(labels.begin(), labels.end());
  std::vector<TileSums> sums(count);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels[i]) {
      sums[labels[i]].add(points.x[i], points.y[i], points.z[i]);
      const auto w = static_cast<std::size_t>(points.width);
      const TileSums& cell = cells.sums[cells.at(static_cast<int>(i % w) / cells.side,
                                                 static_cast<int>(i / w) / cells.side)];
      sums[labels[i]].noise += cell.noise / cell.n;
    }
  TileRegions out;
  std::vector<std::uint16_t> id(count, 0);
  const double tolerance = parameters.accept_tolerance * parameters.accept_tolerance;
  for (std::size_t k = 1; k < count; ++k) {
    if (sums[k].n < parameters.min_points)
      continue;
    const FittedPlane plane = fitSums(sums[k]);
    const double allowed = allowedVariance(plane, noise, parameters);
    if (plane.mse > tolerance * allowed)
      continue;
    // wider than its noise by far, or nothing tells a plane from clutter
    if (plane.width * plane.width <
        parameters.min_width * parameters.min_width * allowed)
      continue;
    out.planes.push_back(plane);
    out.sums.push_back(sums[k]);
    id[k] = static_cast<std::uint16_t>(out.planes.size());
  }
  for (std::uint16_t& l : labels)
    l = id[l];
  assignCells(points, cells, labels, out);
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
Borders findBorders(const OrganizedPoints& points, const TileRegions& regions,
                    const std::vector<std::uint16_t>& labels)
{
  constexpr int REACH = 3;
  const auto width = static_cast<std::size_t>(points.width);
  Borders borders;
  const auto look = [&](std::size_t i, std::size_t j) {
    if (labels[j] == 0 || labels[i] == labels[j])
      return;
    const int a = labels[i] - 1;
    const int b = labels[j] - 1;
    const auto distance = [&](int region, std::size_t k) {
      return regions.planes[static_cast<std::size_t>(region)].distance(
          points.x[k], points.y[k], points.z[k]);
    };
    const double across = distance(a, j);
    const double back = distance(b, i);
    Border& border = borders[std::minmax(a, b)];
    ++border.length;
    border.step += std::min(across * across, back * back);
  };
  for (int v = 0; v < points.height; ++v)
    for (int u = 0; u < points.width; ++u) {
      const std::size_t i =
          static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      if (labels[i] == 0)
        continue;
      if (u + REACH < points.width && labels[i + 1] != labels[i])
        look(i, i + REACH);
      if (v + REACH < points.height && labels[i + width] != labels[i])
        look(i, i + REACH * width);
    }
  return borders;
}

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

void dropCurvedFans(const OrganizedPoints& points, const TileLevel& cells,
                    const NoiseLaw& noise, const AdaptiveParameters& parameters,
                    TileRegions& regions, std::vector<std::uint16_t>& labels)
{
  const double largest =
      parameters.fan_share * static_cast<double>(points.countValid());
  const std::vector<int> fan = fanSizes(findBorders(points, regions, labels), regions,
                                        largest, noise, parameters);
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
  for (std::uint16_t& l : labels)
    l = id[l];
  assignCells(points, cells, labels, kept);
  regions = std::move(kept);
}

} // namespace pcl_mrf_planes::adaptive
