// SPDX-License-Identifier: BSD-3-Clause
#include "planar_patches.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace pcl_mrf_planes::benchmarks::patches {

namespace {

constexpr int NONE = -1;

/// Patches that grow, merge and are fitted anew, in turn.
class Growth {
public:
  Growth(const PointSet& set, std::vector<Patch>& patches)
  : set_(set)
  , patches_(patches)
  , owner_(set.size(), NONE)
  {}

  void run()
  {
    constexpr int MOST_ROUNDS = 50; // it ends by itself
    bool changed = true;
    for (int round = 0; changed && round < MOST_ROUNDS; ++round) {
      sortPatches();
      grow();
      changed = merge();
      changed |= refit();
    }
  }

private:
  /// The patches whose normals agree best come first.
  void sortPatches()
  {
    std::stable_sort(
        patches_.begin(), patches_.end(),
        [](const auto& a, const auto& b) { return a.least_cosine > b.least_cosine; });
    setOwners();
  }

  void setOwners()
  {
    std::fill(owner_.begin(), owner_.end(), NONE);
    for (std::size_t k = 0; k < patches_.size(); ++k)
      for (const int point : patches_[k].members)
        owner_[static_cast<std::size_t>(point)] = static_cast<int>(k);
  }

  template <typename Visit>
  void forNeighbours(int point, Visit visit) const
  {
    const auto first =
        static_cast<std::size_t>(point) * static_cast<std::size_t>(set_.count);
    for (std::size_t k = 0; k < static_cast<std::size_t>(set_.count); ++k)
      visit(set_.neighbours[first + k]);
  }

  /// Points beside those of a patch join it if they are inliers and in no other.
  void grow()
  {
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      Patch& patch = patches_[k];
      for (std::size_t next = 0; next < patch.members.size(); ++next)
        forNeighbours(patch.members[next], [&](int beside) {
          int& owner = owner_[static_cast<std::size_t>(beside)];
          if (owner == NONE && patch.isInlier(set_, beside)) {
            owner = static_cast<int>(k);
            patch.members.push_back(beside);
          }
        });
    }
  }

  /// Pairs of patches with a point beside a point of the other, each an inlier of the
  /// patch that it is not in.
  std::set<std::pair<int, int>> pairsToMerge() const
  {
    std::set<std::pair<int, int>> pairs;
    for (std::size_t point = 0; point < owner_.size(); ++point) {
      const int a = owner_[point];
      if (a == NONE)
        continue;
      forNeighbours(static_cast<int>(point), [&](int beside) {
        const int b = owner_[static_cast<std::size_t>(beside)];
        if (b == NONE || b == a || pairs.count(std::minmax(a, b)) != 0)
          return;
        if (areOnePlane(patches_[static_cast<std::size_t>(a)],
                        patches_[static_cast<std::size_t>(b)], static_cast<int>(point),
                        beside))
          pairs.insert(std::minmax(a, b));
      });
    }
    return pairs;
  }

  bool areOnePlane(const Patch& a, const Patch& b, int of_a, int of_b) const
  {
    const float least_cosine = std::min(a.least_cosine, b.least_cosine);
    const float most_distance = std::max(a.most_distance, b.most_distance);
    const auto agrees = [&](const Patch& patch, int point) {
      const auto k = static_cast<std::size_t>(point);
      return patch.distance(set_.points[k]) < most_distance &&
             patch.cosine(set_.normals[k]) > least_cosine;
    };
    return a.cosine(b.normal) > least_cosine && agrees(a, of_b) && agrees(b, of_a);
  }

  /// The larger of two takes the members of the smaller, and the wider bounds.
  bool merge()
  {
    const auto pairs = pairsToMerge();
    std::vector<std::size_t> root(patches_.size());
    std::iota(root.begin(), root.end(), 0);
    const auto top = [&](int patch) {
      auto k = static_cast<std::size_t>(patch);
      while (root[k] != k)
        k = root[k];
      return k;
    };
    for (const auto& [first, second] : pairs) {
      std::size_t to = top(first), from = top(second);
      if (to == from)
        continue;
      if (patches_[to].members.size() < patches_[from].members.size())
        std::swap(to, from);
      join(patches_[to], patches_[from]);
      root[from] = to;
    }
    patches_.erase(std::remove_if(patches_.begin(), patches_.end(),
                                  [](const Patch& p) { return p.members.empty(); }),
                   patches_.end());
    return !pairs.empty();
  }

  static void join(Patch& to, Patch& from)
  {
    to.members.insert(to.members.end(), from.members.begin(), from.members.end());
    to.least_cosine = std::min(to.least_cosine, from.least_cosine);
    to.most_distance = std::max(to.most_distance, from.most_distance);
    from.members.clear();
  }

  /// Patches that have half as many points again are fitted anew.
  bool refit()
  {
    bool any = false;
    for (Patch& patch : patches_)
      if (2 * patch.members.size() > 3 * patch.fitted) {
        patch.fit(set_);
        any = true;
      }
    return any;
  }

  const PointSet& set_;
  std::vector<Patch>& patches_;
  std::vector<int> owner_; // patch of each point
};

float longestSide(const PointSet& set)
{
  Eigen::Vector3f low = set.points.front(), high = low;
  for (const Eigen::Vector3f& point : set.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).maxCoeff();
}

} // namespace

void growAndMerge(const PointSet& set, const Parameters& parameters,
                  std::vector<Patch>& patches)
{
  if (patches.empty())
    return;
  Growth(set, patches).run();
  const float least = static_cast<float>(parameters.min_edge) * longestSide(set);
  patches.erase(std::remove_if(
                    patches.begin(), patches.end(),
                    [&](const Patch& patch) { return patch.shorterSide(set) < least; }),
                patches.end());
}

} // namespace pcl_mrf_planes::benchmarks::patches
