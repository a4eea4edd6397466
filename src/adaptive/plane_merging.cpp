// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <queue>

namespace pcl_mrf_planes::adaptive {

double allowedVariance(const FittedPlane& plane, const NoiseLaw& noise,
                       const AdaptiveParameters& p)
{
  const double g = noise.growthOf(plane.n);
  const double f = std::min(p.flatness * plane.extent, p.max_flatness);
  return g * g * plane.noise * incidenceFactor(plane) + f * f;
}

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters)
{
  TileRegions out;
  const TileLevel& cells = pyramid[0];
  out.cell_region.assign(cells.sums.size(), -1);
  for (std::size_t l = pyramid.size(); l-- > 0;) {
    const TileLevel& level = pyramid[l];
    const int k = 1 << l;
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.columns; ++c) {
        const FittedPlane& plane = level.planes[level.at(c, r)];
        if (plane.n < 4 || out.cell_region[cells.at(c * k, r * k)] >= 0)
          continue;
        const double tolerance = parameters.tile_tolerance * parameters.tile_tolerance;
        const double mse = plane.mse * plane.n / (plane.n - 3);
        if (mse > tolerance * allowedVariance(plane, noise, parameters))
          continue;
        const int id = static_cast<int>(out.planes.size());
        out.planes.push_back(plane);
        out.sums.push_back(level.sums[level.at(c, r)]);
        for (int j = r * k; j < std::min((r + 1) * k, cells.rows); ++j)
          for (int i = c * k; i < std::min((c + 1) * k, cells.columns); ++i)
            out.cell_region[cells.at(i, j)] = id;
      }
  }
  return out;
}

namespace {

/// union-find with the pooled sums of each set
class Regions {
public:
  explicit Regions(const TileRegions& tiles)
  : sums_(tiles.sums)
  , planes_(tiles.planes)
  , parent_(tiles.sums.size())
  , version_(tiles.sums.size(), 0)
  , neighbours_(tiles.sums.size())
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i)
  {
    while (at(parent_, i) != i)
      i = at(parent_, i) = at(parent_, at(parent_, i));
    return i;
  }

  void touch(int a, int b)
  {
    at(neighbours_, a).push_back(b);
    at(neighbours_, b).push_back(a);
  }

  /// neighbours of a root as roots, each once
  const std::vector<int>& neighbours(int a)
  {
    std::vector<int>& list = at(neighbours_, a);
    for (int& i : list)
      i = find(i);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    list.erase(std::remove(list.begin(), list.end(), a), list.end());
    return list;
  }

  int merge(int a, int b)
  {
    if (at(neighbours_, a).size() < at(neighbours_, b).size())
      std::swap(a, b);
    at(parent_, b) = a;
    at(sums_, a) += at(sums_, b);
    at(planes_, a) = fitSums(at(sums_, a));
    ++at(version_, a);
    ++at(version_, b);
    std::vector<int>& to = at(neighbours_, a);
    std::vector<int>& from = at(neighbours_, b);
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
    from.shrink_to_fit();
    return a;
  }

  const FittedPlane& plane(int i) const { return planes_[static_cast<std::size_t>(i)]; }
  const TileSums& sums(int i) const { return sums_[static_cast<std::size_t>(i)]; }
  int version(int i) const { return version_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(parent_.size()); }

private:
  template <typename T>
  static T& at(std::vector<T>& v, int i)
  {
    return v[static_cast<std::size_t>(i)];
  }

  std::vector<TileSums> sums_;
  std::vector<FittedPlane> planes_;
  std::vector<int> parent_, version_;
  std::vector<std::vector<int>> neighbours_;
};

/// squared deviation of the smaller part from the joint plane over the allowed variance;
/// negative where the joint plane itself is too far from flat
double dissimilarity(const FittedPlane& a, const FittedPlane& b, const TileSums& joint,
                     const NoiseLaw& noise, const AdaptiveParameters& p)
{
  const FittedPlane plane = fitSums(joint);
  const double growth = plane.mse * plane.n - a.mse * a.n - b.mse * b.n;
  const double allowed = allowedVariance(plane, noise, p);
  if (plane.mse > p.region_tolerance * p.region_tolerance * allowed)
    return -1;
  return std::max(0.0, growth) / std::min(a.n, b.n) / allowed;
}

struct Candidate {
  double cost;
  int a, b, version_a, version_b;

  bool operator<(const Candidate& o) const // the queue gives the largest first
  {
    if (cost != o.cost)
      return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

TileRegions collect(Regions& regions, const std::vector<int>& cell_region, double least)
{
  TileRegions out;
  std::vector<int> id(static_cast<std::size_t>(regions.size()), -1);
  for (int i = 0; i < regions.size(); ++i)
    if (regions.find(i) == i && regions.sums(i).n >= least) {
      id[static_cast<std::size_t>(i)] = static_cast<int>(out.planes.size());
      out.planes.push_back(regions.plane(i));
      out.sums.push_back(regions.sums(i));
    }
  out.cell_region.resize(cell_region.size());
  for (std::size_t c = 0; c < cell_region.size(); ++c)
    out.cell_region[c] =
        cell_region[c] < 0 ? -1
                           : id[static_cast<std::size_t>(regions.find(cell_region[c]))];
  return out;
}

} // namespace

TileRegions mergeTouching(const TileRegions& tiles,
                          const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  Regions regions(tiles);
  const TileLevel& cells = pyramid[0];
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      const int a = tiles.cell_region[cells.at(c, r)];
      const int right =
          c + 1 < cells.columns ? tiles.cell_region[cells.at(c + 1, r)] : -1;
      const int down = r + 1 < cells.rows ? tiles.cell_region[cells.at(c, r + 1)] : -1;
      if (a >= 0 && right >= 0 && right != a)
        regions.touch(a, right);
      if (a >= 0 && down >= 0 && down != a)
        regions.touch(a, down);
    }
  std::priority_queue<Candidate> queue;
  const double limit = parameters.merge_tolerance * parameters.merge_tolerance;
  const auto offer = [&](int a, int b) {
    if (a > b)
      std::swap(a, b);
    const double cost =
        dissimilarity(regions.plane(a), regions.plane(b),
                      regions.sums(a) + regions.sums(b), noise, parameters);
    if (cost >= 0 && cost <= limit)
      queue.push({cost, a, b, regions.version(a), regions.version(b)});
  };
  for (int a = 0; a < regions.size(); ++a)
    for (const int b : regions.neighbours(a))
      if (a < b)
        offer(a, b);
  while (!queue.empty()) {
    const Candidate next = queue.top();
    queue.pop();
    if (regions.version(next.a) != next.version_a ||
        regions.version(next.b) != next.version_b)
      continue;
    const int a = regions.merge(next.a, next.b);
    for (const int b : regions.neighbours(a))
      offer(a, b);
  }
  return collect(regions, tiles.cell_region, 0.5 * parameters.min_points);
}

namespace {

/// share of the points on the way between two pixels that lie behind the plane
void walk(const OrganizedPoints& points, const FittedPlane& plane, double tolerance,
          bool over_occluders, int u0, int v0, int u1, int v1, int& behind, int& all)
{
  const int steps = std::max(std::abs(u1 - u0), std::abs(v1 - v0));
  for (int k = 1; k < steps; ++k) {
    const int u = u0 + (u1 - u0) * k / steps;
    const int v = v0 + (v1 - v0) * k / steps;
    const std::size_t i =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(points.width) +
        static_cast<std::size_t>(u);
    if (!points.valid[i])
      continue;
    ++all;
    const double distance = plane.distance(points.x[i], points.y[i], points.z[i]);
    if (distance < -tolerance || (!over_occluders && distance > tolerance))
      ++behind;
  }
}

} // namespace

TileRegions joinCoplanar(const TileRegions& in, const OrganizedPoints& points,
                         const TileLevel& cells, const NoiseLaw& noise,
                         const AdaptiveParameters& parameters)
{
  TileRegions start = in;
  Regions regions(start);
  std::vector<std::vector<std::pair<int, int>>> members(in.planes.size());
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c)
      if (const int id = in.cell_region[cells.at(c, r)]; id >= 0)
        members[static_cast<std::size_t>(id)].emplace_back(c, r);

  const auto unseen_between = [&](int a, int b, const FittedPlane& plane) {
    const auto& ma = members[static_cast<std::size_t>(a)];
    const auto& mb = members[static_cast<std::size_t>(b)];
    const double tolerance = 3 * std::sqrt(allowedVariance(plane, noise, parameters));
    int behind = 0, all = 0, gap = 1 << 30;
    const std::size_t stride = std::max<std::size_t>(1, ma.size() / 12);
    for (std::size_t k = stride / 2; k < ma.size(); k += stride) {
      const auto [ca, ra] = ma[k];
      std::pair<int, int> best = mb.front();
      int best_d = 1 << 30;
      for (const auto& [cb, rb] : mb) {
        const int d = (ca - cb) * (ca - cb) + (ra - rb) * (ra - rb);
        if (d < best_d) {
          best_d = d;
          best = {cb, rb};
        }
      }
      gap = std::min(gap, best_d);
      const int h = cells.side / 2, s = cells.side;
      walk(points, plane, tolerance, parameters.join_over_occluders,
           std::min(ca * s + h, points.width - 1),
           std::min(ra * s + h, points.height - 1),
           std::min(best.first * s + h, points.width - 1),
           std::min(best.second * s + h, points.height - 1), behind, all);
    }
    const double smaller = static_cast<double>(std::min(ma.size(), mb.size()));
    return behind <= parameters.join_seen * all &&
           gap <= parameters.join_gap * parameters.join_gap * smaller;
  };

  const double limit = parameters.join_tolerance * parameters.join_tolerance;
  std::vector<Candidate> pairs;
  for (int a = 0; a < regions.size(); ++a)
    for (int b = a + 1; b < regions.size(); ++b) {
      if (regions.plane(a).normal.dot(regions.plane(b).normal) < 0.9)
        continue;
      const double cost =
          dissimilarity(regions.plane(a), regions.plane(b),
                        regions.sums(a) + regions.sums(b), noise, parameters);
      if (cost >= 0 && cost <= limit)
        pairs.push_back({cost, a, b, 0, 0});
    }
  std::sort(pairs.begin(), pairs.end(),
            [](const Candidate& p, const Candidate& q) { return q < p; });
  for (const Candidate& p : pairs) {
    const int a = regions.find(p.a), b = regions.find(p.b);
    if (a == b)
      continue;
    const TileSums joint = regions.sums(a) + regions.sums(b);
    const double cost =
        dissimilarity(regions.plane(a), regions.plane(b), joint, noise, parameters);
    if (cost < 0 || cost > limit || !unseen_between(p.a, p.b, fitSums(joint)))
      continue;
    regions.merge(a, b);
  }
  return collect(regions, in.cell_region, parameters.min_points * 0.5);
}

} // namespace pcl_mrf_planes::adaptive
