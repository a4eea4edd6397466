// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_clustering.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace pcl_mrf_planes {

namespace {

constexpr int AXES = 4; // a, b, c, d

/// What orders planes by content alone, so that the order of the input has no say.
auto content(const PlaneModel& m)
{
  return std::make_tuple(m.error, m.plane.normal.x(), m.plane.normal.y(),
                         m.plane.normal.z(), m.plane.d, m.points);
}

/// The planes still alive and the plane that each one's data refers to.
class Merger {
public:
  Merger(const std::vector<PlaneModel>& models, double beta, double threshold)
  : models_(models)
  , beta_(beta)
  , threshold_(threshold)
  , refers_to_(models.size())
  {
    std::iota(refers_to_.begin(), refers_to_.end(), std::size_t{0});
    alive_ = refers_to_;
  }

  void run()
  {
    bool merged = true;
    while (merged) {
      merged = false;
      for (int axis = 0; axis < AXES; ++axis)
        merged = mergeAlongAxis(axis) || merged;
    }
    closeRemainingPairs();
  }

  /// Survivors, in no particular order.
  const std::vector<std::size_t>& survivors() const { return alive_; }

  /// The survivor that plane \a i ended at; halves the path on the way.
  std::size_t survivorOf(std::size_t i)
  {
    while (refers_to_[i] != i) {
      refers_to_[i] = refers_to_[refers_to_[i]];
      i = refers_to_[i];
    }
    return i;
  }

private:
  bool similar(std::size_t i, std::size_t j) const
  {
    return dissimilarity(models_[i].plane, models_[j].plane, beta_) < threshold_; // (5)
  }

  bool better(std::size_t i, std::size_t j) const
  {
    return content(models_[i]) < content(models_[j]);
  }

  /// One walk along the projection onto one coefficient; true if planes merged.
  bool mergeAlongAxis(int axis)
  {
    const auto projection = [&](std::size_t i) {
      return std::make_tuple(models_[i].plane.coefficient(axis), content(models_[i]));
    };
    std::sort(alive_.begin(), alive_.end(), [&](std::size_t i, std::size_t j) {
      return projection(i) < projection(j);
    });
    std::vector<std::size_t> kept;
    for (const std::size_t next : alive_) {
      if (kept.empty() || !similar(kept.back(), next)) {
        kept.push_back(next);
        continue;
      }
      const std::size_t last = kept.back();
      const bool next_wins = better(next, last);
      refers_to_[next_wins ? last : next] = next_wins ? next : last;
      kept.back() = next_wins ? next : last;
    }
    const bool merged = kept.size() < alive_.size();
    alive_ = std::move(kept);
    return merged;
  }

  /// Best plane first: each later one joins the most similar one before it, if any is
  /// below the threshold. What remains is pairwise at least the threshold apart.
  void closeRemainingPairs()
  {
    std::sort(alive_.begin(), alive_.end(),
              [&](std::size_t i, std::size_t j) { return better(i, j); });
    std::vector<std::size_t> kept;
    for (const std::size_t next : alive_) {
      std::size_t closest = next;
      double least = threshold_;
      for (const std::size_t candidate : kept) {
        const double e =
            dissimilarity(models_[candidate].plane, models_[next].plane, beta_);
        if (e < least) {
          least = e;
          closest = candidate;
        }
      }
      refers_to_[next] = closest;
      if (closest == next)
        kept.push_back(next);
    }
    alive_ = std::move(kept);
  }

  const std::vector<PlaneModel>& models_;
  double beta_;
  double threshold_;
  std::vector<std::size_t> refers_to_;
  std::vector<std::size_t> alive_;
};

} // namespace

PlaneClusters mergePlanes(const std::vector<PlaneModel>& models, double beta,
                          double threshold)
{
  Merger merger(models, beta, threshold);
  merger.run();

  std::vector<double> support(models.size(), 0.0);
  for (std::size_t i = 0; i < models.size(); ++i)
    support[merger.survivorOf(i)] += models[i].points;

  std::vector<std::size_t> order = merger.survivors();
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::make_tuple(-support[i], content(models[i])) <
           std::make_tuple(-support[j], content(models[j]));
  });

  PlaneClusters clusters;
  std::vector<int> label(models.size(), PlaneClusters::NONE);
  for (const std::size_t i : order) {
    label[i] = static_cast<int>(clusters.planes.size());
    clusters.planes.push_back({models[i].plane, models[i].error, support[i]});
  }
  for (std::size_t i = 0; i < models.size(); ++i)
    clusters.assignment.push_back(label[merger.survivorOf(i)]);
  return clusters;
}

PlaneClusters clusterTilePlanes(const TileImage& image, const Parameters& parameters)
{
  std::vector<PlaneModel> models;
  std::vector<std::size_t> tile_of_model;
  for (std::size_t i = 0; i < image.tiles.size(); ++i) {
    const TilePlane& tile = image.tiles[i];
    if (!tile.kept())
      continue;
    models.push_back({tile.fit.plane, tile.fit.rms, tile.sums.n});
    tile_of_model.push_back(i);
  }

  PlaneClusters clusters =
      mergePlanes(models, parameters.beta, parameters.merge_threshold);
  const auto limit = static_cast<std::size_t>(parameters.max_planes);
  if (clusters.planes.size() > limit)
    clusters.planes.resize(limit);

  std::vector<int> tile_plane(image.tiles.size(), PlaneClusters::NONE);
  for (std::size_t i = 0; i < models.size(); ++i)
    if (clusters.assignment[i] < parameters.max_planes)
      tile_plane[tile_of_model[i]] = clusters.assignment[i];
  clusters.assignment = std::move(tile_plane);
  return clusters;
}

} // namespace pcl_mrf_planes
