// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_clustering.h>

#include "frame_memory.h"
#include "paper_stages.h"

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

/// Some planes that follow each other in memory.
struct PlaneModels {
  const PlaneModel* first;
  std::size_t count;
};

/// The planes still alive and the plane that each one's data refers to.
class Merger {
public:
  Merger(PlaneModels models, double beta, double threshold)
  : models_(models.first)
  , beta_(beta)
  , threshold_(threshold)
  , refers_to_(models.count)
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
  const FrameVector<std::size_t>& survivors() const { return alive_; }

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
    FrameVector<std::size_t> kept;
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
    FrameVector<std::size_t> kept;
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

  const PlaneModel* models_;
  double beta_;
  double threshold_;
  FrameVector<std::size_t> refers_to_;
  FrameVector<std::size_t> alive_;
};

/// \param planes those that are left \return which of them each one refers to
FrameVector<int> merge(PlaneModels models, double beta, double threshold,
                       std::vector<PlaneModel>& planes)
{
  Merger merger(models, beta, threshold);
  merger.run();

  FrameVector<double> support(models.count, 0.0);
  for (std::size_t i = 0; i < models.count; ++i)
    support[merger.survivorOf(i)] += models.first[i].points;

  FrameVector<std::size_t> order = merger.survivors();
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::make_tuple(-support[i], content(models.first[i])) <
           std::make_tuple(-support[j], content(models.first[j]));
  });

  planes.clear();
  FrameVector<int> label(models.count, PlaneClusters::NONE);
  for (const std::size_t i : order) {
    label[i] = static_cast<int>(planes.size());
    planes.push_back({models.first[i].plane, models.first[i].error, support[i]});
  }
  FrameVector<int> assignment;
  assignment.reserve(models.count);
  for (std::size_t i = 0; i < models.count; ++i)
    assignment.push_back(label[merger.survivorOf(i)]);
  return assignment;
}

} // namespace

PlaneClusters mergePlanes(const std::vector<PlaneModel>& models, double beta,
                          double threshold)
{
  PlaneClusters clusters;
  const FrameVector<int> assignment =
      merge({models.data(), models.size()}, beta, threshold, clusters.planes);
  clusters.assignment.assign(assignment.begin(), assignment.end());
  return clusters;
}

PlaneClusters clusterTilePlanes(const TileImage& image, const Parameters& parameters)
{
  PlaneClusters clusters;
  clusterTilePlanes(image, parameters, clusters);
  return clusters;
}

void clusterTilePlanes(const TileImage& image, const Parameters& parameters,
                       PlaneClusters& clusters)
{
  FrameVector<PlaneModel> models;
  FrameVector<std::size_t> tile_of_model;
  for (std::size_t i = 0; i < image.tiles.size(); ++i) {
    const TilePlane& tile = image.tiles[i];
    if (!tile.kept())
      continue;
    models.push_back({tile.fit.plane, tile.fit.rms, tile.sums.n});
    tile_of_model.push_back(i);
  }

  const FrameVector<int> assignment =
      merge({models.data(), models.size()}, parameters.beta, parameters.merge_threshold,
            clusters.planes);
  const auto limit = static_cast<std::size_t>(parameters.max_planes);
  if (clusters.planes.size() > limit)
    clusters.planes.resize(limit);

  clusters.assignment.assign(image.tiles.size(), PlaneClusters::NONE);
  for (std::size_t i = 0; i < models.size(); ++i)
    if (assignment[i] < parameters.max_planes)
      clusters.assignment[tile_of_model[i]] = assignment[i];
}

} // namespace pcl_mrf_planes
