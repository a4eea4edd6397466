// SPDX-License-Identifier: BSD-3-Clause
#include "algorithm_film.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_mrf_planes::viewer {

namespace {

/// Every kept tile in a colour of its own.
FilmStep tileStep(const TileCells& cells)
{
  FilmStep step;
  step.title = "detected tiles";
  const auto kept = std::count_if(cells.tiles.begin(), cells.tiles.end(),
                                  [](const StageTile& tile) { return tile.kept; });
  step.note = std::to_string(kept) + " tiles are kept";
  step.labels.assign(cells.tile_of_point.size(), 0);
  for (std::size_t i = 0; i < step.labels.size(); ++i) {
    const int tile = cells.tile_of_point[i];
    if (tile >= 0 && cells.tiles[static_cast<std::size_t>(tile)].kept)
      step.labels[i] = static_cast<std::uint16_t>(tile + 1);
  }
  for (std::size_t t = 0; t < cells.tiles.size(); ++t)
    step.classes.push_back(static_cast<std::uint32_t>(t + 1));
  return step;
}

FilmStep mergedStep(const TileCells& cells, std::size_t planes)
{
  return {"merged planes", std::to_string(planes) + " planes", cells.mergedLabels(),
          cells.classes, -1};
}

std::string titleOf(const StageLabels& stage)
{
  const std::string count = std::to_string(stage.count);
  switch (stage.stage) {
  case Stage::ITERATION:
    return "labels after " + count + (stage.count == 1 ? " iteration" : " iterations");
  case Stage::CELLS:
    return "cells, round " + count;
  case Stage::JOINED:
    return "coplanar planes joined";
  case Stage::REFINED:
    return "planes fitted again";
  case Stage::FINAL:
    return "result";
  default:
    return stageName(stage.stage);
  }
}

FilmStep labelStep(const StageLabels& stage, const apps::ColourTrack& track)
{
  FilmStep step;
  step.title = titleOf(stage);
  step.note = std::to_string(stage.planes.size()) + " planes";
  if (stage.energy)
    step.note += ", energy " + std::to_string(std::lround(stage.energy->total()));
  step.labels = stage.labels;
  apps::ColourTrack own = track;
  step.classes = own.update(stage.planes, stage.labels);
  if (stage.stage == Stage::ITERATION)
    step.iteration = stage.count;
  return step;
}

} // namespace

AlgorithmFilm filmOf(const SegmentationStages& stages, const TileCells& cells,
                     const apps::ColourTrack& track)
{
  AlgorithmFilm film;
  film.steps.push_back(tileStep(cells));
  film.steps.push_back(mergedStep(cells, stages.merged_planes.size()));
  for (const StageLabels& stage : stages.labels) {
    if (stage.stage == Stage::MERGED) // the step before shows it
      continue;
    film.steps.push_back(labelStep(stage, track));
    if (stage.stage == Stage::ITERATION && stage.energy)
      film.energy.push_back(stage.energy->total());
  }
  return film;
}

} // namespace pcl_mrf_planes::viewer
