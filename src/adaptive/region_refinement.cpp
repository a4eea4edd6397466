// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/region_refinement.h"
#include "adaptive/surface_bend.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace pcl_mrf_planes::adaptive {

namespace {

/// labels of 4-connected components below the least size become 0
void dropSmallComponents(const OrganizedPoints& points, std::size_t least,
                         std::vector<std::uint16_t>& labels)
{
  const std::size_t w = static_cast<std::size_t>(points.width);
  std::vector<std::uint8_t> seen(labels.size(), 0);
  std::vector<std::size_t> stack, members;
  for (std::size_t start = 0; start < labels.size(); ++start) {
    if (seen[start] || labels[start] == 0)
      continue;
    const std::uint16_t label = labels[start];
    stack.assign(1, start);
    members.clear();
    seen[start] = 1;
    while (!stack.empty()) {
      const std::size_t i = stack.back();
      stack.pop_back();
      members.push_back(i);
      const std::size_t u = i % w;
      const auto visit = [&](std::size_t j) {
        if (!seen[j] && labels[j] == label) {
          seen[j] = 1;
          stack.push_back(j);
        }
      };
      if (u > 0)
        visit(i - 1);
      if (u + 1 < w)
        visit(i + 1);
      if (i >= w)
        visit(i - w);
      if (i + w < labels.size())
        visit(i + w);
    }
    if (members.size() < least)
      for (const std::size_t i : members)
        labels[i] = 0;
  }
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
  dropSmallComponents(points, static_cast<std::size_t>(parameters.min_points / 4),
                      labels);
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

void dropCurvedFans(const OrganizedPoints& points, const TileLevel& cells,
                    const NoiseLaw& noise, const AdaptiveParameters& parameters,
                    TileRegions& regions, std::vector<std::uint16_t>& labels)
{
  const std::size_t count = regions.planes.size();
  struct Border {
    int length = 0;
    double step = 0; // sum of squared distances across, both ways
  };
  std::map<std::pair<int, int>, Border> borders;
  const int w = points.width, h = points.height, reach = 3;
  double valid = 0;
  const auto look = [&](std::size_t i, std::size_t j) {
    if (!labels[j] || labels[i] == labels[j])
      return;
    const int a = std::min(labels[i], labels[j]) - 1,
              b = std::max(labels[i], labels[j]) - 1;
    const FittedPlane& pa = regions.planes[static_cast<std::size_t>(labels[i] - 1)];
    const FittedPlane& pb = regions.planes[static_cast<std::size_t>(labels[j] - 1)];
    const double da = pa.distance(points.x[j], points.y[j], points.z[j]);
    const double db = pb.distance(points.x[i], points.y[i], points.z[i]);
    Border& border = borders[{a, b}];
    ++border.length;
    border.step += std::min(da * da, db * db);
  };
  for (int v = 0; v < h; ++v)
    for (int u = 0; u < w; ++u) {
      const std::size_t i = static_cast<std::size_t>(v) * static_cast<std::size_t>(w) +
                            static_cast<std::size_t>(u);
      valid += points.valid[i];
      if (!labels[i])
        continue;
      if (u + reach < w && labels[i + 1] != labels[i])
        look(i, i + static_cast<std::size_t>(reach));
      if (v + reach < h && labels[i + static_cast<std::size_t>(w)] != labels[i])
        look(i, i + static_cast<std::size_t>(reach) * static_cast<std::size_t>(w));
    }
  const double cos_fan = std::cos(parameters.fan_angle * 3.14159265358979 / 180);
  std::vector<std::size_t> parent(count);
  for (std::size_t k = 0; k < count; ++k)
    parent[k] = k;
  const auto find = [&](std::size_t k) {
    while (parent[k] != k)
      k = parent[k];
    return k;
  };
  for (const auto& [pair, border] : borders) {
    const auto a = static_cast<std::size_t>(pair.first);
    const auto b = static_cast<std::size_t>(pair.second);
    const FittedPlane& pa = regions.planes[a];
    const FittedPlane& pb = regions.planes[b];
    const double largest = parameters.fan_share * valid;
    if (pa.n > largest || pb.n > largest || pa.normal.dot(pb.normal) < cos_fan)
      continue;
    if (border.length < parameters.fan_border * std::sqrt(std::min(pa.n, pb.n)))
      continue;
    const double allowed = std::max(allowedVariance(pa, noise, parameters),
                                    allowedVariance(pb, noise, parameters)) +
                           std::pow(0.002 * pa.centroid.norm(), 2);
    if (border.step / border.length > parameters.fan_gap * parameters.fan_gap * allowed)
      continue;
    parent[std::max(find(a), find(b))] = std::min(find(a), find(b));
  }
  const std::vector<Bend> bends = measureBends(points, labels, regions.planes);
  const double turn = parameters.bend_angle * 3.14159265358979 / 180;
  const auto curved = [&](std::size_t k) {
    return bends[k].angle > turn && bends[k].share > parameters.bend_share;
  };
  std::vector<int> members(count, 0);
  for (std::size_t k = 0; k < count; ++k)
    ++members[find(k)];
  std::vector<std::uint16_t> id(count + 1, 0);
  TileRegions kept;
  for (std::size_t k = 0; k < count; ++k)
    if (members[find(k)] < parameters.fan_parts && !curved(k)) {
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
