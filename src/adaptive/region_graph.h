// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Regions that merge: a union-find with the pooled sums of each set.
class Regions {
public:
  explicit Regions(const TileRegions& tiles)
  : sums_(tiles.sums)
  , planes_(tiles.planes)
  , parent_(tiles.sums.size())
  , tiles_(tiles.sums.size(), 1)
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
    if (!at(neighbours_, a).empty() && at(neighbours_, a).back() == b)
      return; // along a border of several cells
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
    at(tiles_, a) += at(tiles_, b);
    std::vector<int>& to = at(neighbours_, a);
    std::vector<int>& from = at(neighbours_, b);
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
    from.shrink_to_fit();
    return a;
  }

  const FittedPlane& plane(int i) const { return planes_[static_cast<std::size_t>(i)]; }
  const TileSums& sums(int i) const { return sums_[static_cast<std::size_t>(i)]; }
  /// Tiles that a root is made of; grows with every merge.
  int tiles(int i) const { return tiles_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(parent_.size()); }

private:
  template <typename T>
  static T& at(std::vector<T>& v, int i)
  {
    return v[static_cast<std::size_t>(i)];
  }

  std::vector<TileSums> sums_;
  std::vector<FittedPlane> planes_;
  std::vector<int> parent_, tiles_;
  std::vector<std::vector<int>> neighbours_;
};

/// A pair of regions to merge, as they were when it was looked at.
struct Candidate {
  double cost;
  int a, b;
  int tiles; ///< of both

  bool operator<(const Candidate& o) const // the queue gives the largest first
  {
    if (cost != o.cost)
      return cost > o.cost;
    return a != o.a ? a > o.a : b > o.b;
  }
};

/// Squared deviation of the smaller part from the joint plane over the allowed variance;
/// negative where the joint plane itself is too far from flat.
double dissimilarity(const FittedPlane& a, const FittedPlane& b, const TileSums& joint,
                     const NoiseLaw& noise, const AdaptiveParameters& p);

/// The sets that hold at least so many points, numbered in order.
TileRegions collect(Regions& regions, const std::vector<int>& cell_region,
                    double least);

} // namespace pcl_mrf_planes::adaptive
