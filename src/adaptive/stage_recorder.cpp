// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/stage_recorder.h"
#include "adaptive/field_energy.h"
#include "adaptive/sampled_points.h"
#include "adaptive/stage_observer.h"
#include "adaptive/workspace.h"
#include "frame_memory.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

std::vector<Plane> planesOf(const FittedRegions& regions)
{
  return {regions.planes.begin(), regions.planes.end()};
}

/// Writes down what it sees, in the size of all points.
class StageRecorder : public StageObserver {
public:
  StageRecorder(const OrganizedPoints& points, int sampling, SegmentationStages& stages)
  : points_(points)
  , every_(sampling)
  , stages_(stages)
  {}

  void seeTiles(const TileRegions& tiles, const TileLevel& cells) override
  {
    tile_of_cell_ = tiles.cell_region;
    stages_.tiles.resize(tiles.planes.size());
    for (std::size_t k = 0; k < tiles.planes.size(); ++k) {
      StageTile& tile = stages_.tiles[k];
      tile.kept = true;
      tile.plane = tiles.planes[k];
      tile.rms = std::sqrt(std::max(0.0, tiles.planes[k].mse));
    }
    for (int row = 0; row < cells.rows; ++row)
      for (int column = 0; column < cells.columns; ++column)
        if (const int k = tile_of_cell_[cells.at(column, row)]; k >= 0)
          cover(stages_.tiles[static_cast<std::size_t>(k)], column, row);
  }

  void seeRegions(Stage stage, const TileRegions& regions,
                  const TileLevel& cells) override
  {
    planes_ = planesOf(regions);
    if (stage != Stage::CELLS) {
      stages_.merged_planes = planes_;
      for (std::size_t c = 0; c < tile_of_cell_.size(); ++c)
        if (tile_of_cell_[c] >= 0)
          stages_.tiles[static_cast<std::size_t>(tile_of_cell_[c])].merged =
              regions.cell_region[c];
    }
    rounds_ = stage == Stage::CELLS ? rounds_ + 1 : 0;
    std::vector<std::uint16_t> labels(points_.size(), 0);
    forEachPoint([&](std::size_t i, int x, int y) {
      labels[i] = static_cast<std::uint16_t>(
          regions.cell_region[cells.at(x / CELL, y / CELL)] + 1);
    });
    add(stage, rounds_, std::move(labels), planes_);
  }

  void seeField(const CandidateField& field, const OrganizedPoints& samples,
                const AdaptiveParameters& parameters) override
  {
    for (int passes = 0; passes <= parameters.passes; ++passes) {
      const auto labels = propagateBeliefs(field, samples, passes);
      add(Stage::ITERATION, passes, ofAllPoints(labels, samples.width), planes_);
      stages_.labels.back().energy = fieldEnergy(field, samples, labels, parameters);
    }
    sample_width_ = samples.width;
  }

  void seeImage(Stage stage, const FittedRegions& regions,
                const LabelledPoints& image) override
  {
    add(stage, 0, ofAllPoints(image.labels, sample_width_), planesOf(regions));
  }

private:
  /// Makes a tile take in a cell of its own.
  void cover(StageTile& tile, int column, int row) const
  {
    const int side = CELL * every_;
    const int left = column * side;
    const int top = row * side;
    if (tile.width == 0) { // its first one is the upper left one
      tile.x = left;
      tile.y = top;
    }
    tile.width = std::max(tile.width, std::min(left + side, points_.width) - tile.x);
    tile.height = std::max(tile.height, std::min(top + side, points_.height) - tile.y);
  }

  /// Calls visit(index, x, y) for valid points, with the place of their samples.
  template <typename Visit>
  void forEachPoint(const Visit& visit) const
  {
    std::size_t i = 0;
    for (int y = 0; y < points_.height; ++y)
      for (int x = 0; x < points_.width; ++x, ++i)
        if (points_.valid[i] != 0)
          visit(i, x / every_, y / every_);
  }

  std::vector<std::uint16_t> ofAllPoints(const std::vector<std::uint16_t>& labels,
                                         int width) const
  {
    std::vector<std::uint16_t> all(points_.size(), 0);
    forEachPoint([&](std::size_t i, int x, int y) {
      all[i] = labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    });
    return all;
  }

  void add(Stage stage, int count, std::vector<std::uint16_t> labels,
           std::vector<Plane> planes)
  {
    stages_.labels.push_back(
        {stage, count, std::move(labels), std::move(planes), std::nullopt});
  }

  const OrganizedPoints& points_;
  int every_;
  SegmentationStages& stages_;
  FrameVector<int> tile_of_cell_;
  std::vector<Plane> planes_; ///< of the regions seen last
  int rounds_ = 0;
  int sample_width_ = 0;
};

} // namespace

SegmentationStages recordAdaptive(const OrganizedPoints& points,
                                  const Parameters& parameters)
{
  SegmentationStages stages;
  StageRecorder recorder(points, samplingStep(points, parameters.adaptive), stages);
  Workspace workspace;
  segmentObserved(points, parameters, &recorder, workspace, stages.result);
  return stages;
}

} // namespace pcl_mrf_planes::adaptive
