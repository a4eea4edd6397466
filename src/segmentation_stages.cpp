// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/segmentation_stages.h>

#include "adaptive/stage_recorder.h"

#include <pcl_mrf_planes/belief_propagation.h>

#include <algorithm>
#include <utility>

namespace pcl_mrf_planes {

namespace {

StageTile tileOf(const OrganizedPoints& points, const TileImage& image, std::size_t k)
{
  const auto columns = static_cast<std::size_t>(image.columns);
  const TilePlane& from = image.tiles[k];
  StageTile tile;
  tile.x = static_cast<int>(k % columns) * image.tile_width;
  tile.y = static_cast<int>(k / columns) * image.tile_height;
  tile.width = std::min(image.tile_width, points.width - tile.x);
  tile.height = std::min(image.tile_height, points.height - tile.y);
  tile.kept = from.kept();
  tile.plane = from.fit.plane;
  tile.rms = from.fit.rms;
  return tile;
}

/// Tiles, what they were merged to, and the labels that this alone would give.
void recordMerging(const OrganizedPoints& points, SegmentationStages& stages)
{
  const TileImage& image = stages.result.tiles;
  const PlaneClusters& clusters = stages.result.clusters;
  for (const PlaneModel& model : clusters.planes)
    stages.merged_planes.push_back(model.plane);
  for (std::size_t k = 0; k < image.tiles.size(); ++k) {
    stages.tiles.push_back(tileOf(points, image, k));
    if (k < clusters.assignment.size())
      stages.tiles.back().merged = clusters.assignment[k];
  }
  StageLabels merged = {Stage::MERGED, 0, std::vector<std::uint16_t>(points.size(), 0),
                        stages.merged_planes, std::nullopt};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto width = static_cast<std::size_t>(points.width);
    const std::size_t k =
        image.tileAt(static_cast<int>(i % width), static_cast<int>(i / width));
    if (points.valid[i] != 0)
      merged.labels[i] = static_cast<std::uint16_t>(stages.tiles[k].merged + 1);
  }
  stages.labels.push_back(std::move(merged));
}

/// Labels after 0, 1, 2, ... iterations, as many as the segmentation did.
void recordIterations(const OrganizedPoints& points, const Parameters& parameters,
                      SegmentationStages& stages)
{
  const PlaneField field(points, stages.merged_planes, parameters);
  const GridField grid = field.toGridField();
  BeliefPropagation propagation(grid, parameters.number_of_threads);
  for (int done = 0;; ++done) {
    StageLabels after;
    after.stage = Stage::ITERATION;
    after.count = done;
    after.labels = propagation.mapLabels();
    after.planes = stages.merged_planes;
    after.energy = field.energy(after.labels);
    for (std::size_t i = 0; i < points.size(); ++i)
      after.labels[i] = points.valid[i] != 0
                            ? static_cast<std::uint16_t>(after.labels[i] + 1)
                            : std::uint16_t{0};
    stages.labels.push_back(std::move(after));
    if (done >= stages.result.report.iterations)
      return;
    propagation.iterate(1);
  }
}

SegmentationStages recordPaper(const OrganizedPoints& points,
                               const Parameters& parameters)
{
  SegmentationStages stages;
  stages.result = segmentAsInPaper(points, parameters);
  recordMerging(points, stages);
  if (!stages.merged_planes.empty())
    recordIterations(points, parameters, stages);
  return stages;
}

} // namespace

std::string stageName(Stage stage)
{
  switch (stage) {
  case Stage::MERGED:
    return "merged";
  case Stage::JOINED:
    return "joined";
  case Stage::CELLS:
    return "cells";
  case Stage::ITERATION:
    return "iteration";
  case Stage::REFINED:
    return "refined";
  default:
    return "final";
  }
}

SegmentationStages recordStages(const OrganizedPoints& points,
                                const Parameters& parameters)
{
  SegmentationStages stages = parameters.method == Method::PAPER
                                  ? recordPaper(points, parameters)
                                  : adaptive::recordAdaptive(points, parameters);
  stages.width = points.width;
  stages.height = points.height;
  StageLabels last;
  last.labels = stages.result.labels;
  for (const PlaneRegion& region : stages.result.regions)
    last.planes.push_back(region.plane);
  stages.labels.push_back(std::move(last));
  return stages;
}

} // namespace pcl_mrf_planes
