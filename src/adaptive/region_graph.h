// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/// Two regions side by side.
struct Touch {
  int a, b;
};

/// Regions that merge: a union-find with the pooled sums of each set.
class Regions {
public:
  explicit Regions(FittedRegions tiles)
  : sums_(std::move(tiles.sums))
  , planes_(std::move(tiles.planes))
  , parent_(sums_.size())
  , tiles_(sums_.size(), 1)
  , lists_(sums_.size())
  , marks_(sums_.size(), 0)
  {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i)
  {
    while (at(parent_, i) != i)
      i = at(parent_, i) = at(parent_, at(parent_, i));
    return i;
  }

  /// The same; any number of threads may ask, as nothing is written.
  int rootOf(int i) const
  {
    while (parent_[static_cast<std::size_t>(i)] != i)
      i = parent_[static_cast<std::size_t>(i)];
    return i;
  }

  bool isRoot(int i) const { return parent_[static_cast<std::size_t>(i)] == i; }

  void touch(int a, int b)
  {
    if (isLast(a, b))
      return; // along a border of several cells
    links_.resize(links_.size() + 2);
    const auto k = static_cast<int>(links_.size());
    append(a, b, k - 2);
    append(b, a, k - 1);
  }

  /// The same for groups of sets that have no set in common.
  void touchAll(const FrameVector<FrameVector<Touch>>& groups, unsigned int threads)
  {
    FrameVector<int> first = {static_cast<int>(links_.size())}; // link of each group
    for (const FrameVector<Touch>& group : groups)
      first.push_back(first.back() + 2 * static_cast<int>(group.size()));
    links_.resize(static_cast<std::size_t>(first.back()));
    parallelParts(static_cast<int>(groups.size()), threads, [&](int group) {
      int k = at(first, group);
      for (const auto& [a, b] : groups[static_cast<std::size_t>(group)])
        if (!isLast(a, b)) {
          append(a, b, k++);
          append(b, a, k++);
        }
    });
  }

  /// Calls visit(b) for the neighbours of a root, as roots, each once.
  /// \param[in] mark a number that no walk here had before
  template <typename Visit>
  void forEachNeighbour(int a, int mark, const Visit& visit)
  {
    at(marks_, a) = mark;
    List& list = at(lists_, a);
    int before = NO_LINK;
    for (int k = list.first; k != NO_LINK; k = at(links_, k).next) {
      Link& link = at(links_, k);
      link.to = find(link.to);
      if (at(marks_, link.to) == mark) { // known: leaves the list
        (before == NO_LINK ? list.first : at(links_, before).next) = link.next;
        if (link.next == NO_LINK)
          list.last = before;
        continue;
      }
      at(marks_, link.to) = mark;
      before = k;
      visit(link.to);
    }
  }

  /// \param[in] joint plane of the sums of both
  int merge(int a, int b, const FittedPlane& joint)
  {
    if (tiles(a) < tiles(b))
      std::swap(a, b);
    at(parent_, b) = a;
    at(sums_, a) += at(sums_, b);
    at(planes_, a) = joint;
    at(tiles_, a) += at(tiles_, b);
    List& to = at(lists_, a);
    const List& from = at(lists_, b);
    if (from.first != NO_LINK) {
      (to.last == NO_LINK ? to.first : at(links_, to.last).next) = from.first;
      to.last = from.last;
    }
    return a;
  }

  const FittedPlane& plane(int i) const { return planes_[static_cast<std::size_t>(i)]; }
  const TileSums& sums(int i) const { return sums_[static_cast<std::size_t>(i)]; }
  /// Tiles that a root is made of; grows with every merge.
  int tiles(int i) const { return tiles_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(parent_.size()); }

private:
  static constexpr int NO_LINK = -1;

  /// A neighbour in a list of them; lists are joined without copying.
  struct Link {
    int to = NO_LINK;
    int next = NO_LINK;
  };
  struct List {
    int first = NO_LINK;
    int last = NO_LINK;
  };

  /// Whether b is the neighbour of a that was met last.
  bool isLast(int a, int b)
  {
    const int last = at(lists_, a).last;
    return last != NO_LINK && at(links_, last).to == b;
  }

  /// Adds a neighbour to a list, by link number \a k.
  void append(int a, int b, int k)
  {
    at(links_, k) = {b, NO_LINK};
    List& list = at(lists_, a);
    (list.last == NO_LINK ? list.first : at(links_, list.last).next) = k;
    list.last = k;
  }

  template <typename T>
  static T& at(FrameVector<T>& v, int i)
  {
    return v[static_cast<std::size_t>(i)];
  }

  FrameVector<TileSums> sums_;
  FrameVector<FittedPlane> planes_;
  FrameVector<int> parent_, tiles_;
  FrameVector<List> lists_; ///< neighbours of each set
  FrameVector<Link> links_;
  FrameVector<int> marks_; ///< sets that the walk of this mark has met
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
double dissimilarity(const FittedPlane& a, const FittedPlane& b,
                     const FittedPlane& joint, const NoiseLaw& noise,
                     const AdaptiveParameters& p);

/// The sets that hold at least so many points, numbered in order.
TileRegions collect(Regions& regions, FrameVector<int> cell_region, double least,
                    unsigned int threads);

} // namespace pcl_mrf_planes::adaptive
