// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_segmentation.h>

#include "adaptive/block_noise.h"
#include "adaptive/candidate_field.h"
#include "adaptive/cell_labelling.h"
#include "adaptive/curved_surfaces.h"
#include "adaptive/noise_estimation.h"
#include "adaptive/plane_evidence.h"
#include "adaptive/plane_merging.h"
#include "adaptive/region_refinement.h"
#include "adaptive/sampled_points.h"
#include "adaptive/stage_observer.h"
#include "adaptive/tile_pyramid.h"
#include "adaptive/workspace.h"
#include "region_gathering.h"
#include "stage_timer.h"
#include "threads.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace pcl_mrf_planes {

namespace {

using namespace adaptive;

constexpr std::size_t MOST_PLANES = 65000; // labels are 16-bit numbers

std::size_t countTiles(const std::vector<TileLevel>& pyramid)
{
  std::size_t tiles = 0;
  for (const TileLevel& level : pyramid)
    tiles += level.sums.size();
  return tiles;
}

/// Runs of labels from 1, with 0 for none, as those of label planes from 0.
LabelRuns planeRuns(const LabelRuns& image, unsigned int threads)
{
  LabelRuns out;
  out.width = image.width;
  out.rows.resize(image.rows.size(), 0);
  const int rows = static_cast<int>(image.rows.size()) - 1;
  const auto forEachRun = [&](int row, const auto& visit) {
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t k = image.rows[r]; k < image.rows[r + 1]; ++k)
      if (image.runs[k].label != 0)
        visit(image.runs[k]);
  };
  parallelRows(rows, threads, [&](int row) {
    forEachRun(row,
               [&](const LabelRun&) { ++out.rows[static_cast<std::size_t>(row) + 1]; });
  });
  std::partial_sum(out.rows.begin(), out.rows.end(), out.rows.begin());
  out.runs.resize(out.rows.back());
  parallelRows(rows, threads, [&](int row) {
    std::size_t k = out.rows[static_cast<std::size_t>(row)];
    forEachRun(row, [&](const LabelRun& run) {
      out.runs[k++] = {run.begin, run.end, static_cast<std::uint16_t>(run.label - 1)};
    });
  });
  return out;
}

/// What the stages find in points, all of them or samples.
struct Labelling {
  NoiseLaw noise;
  FittedRegions fitted;
  LabelledPoints image;
};

/// Where the stages write down what they do, and who looks on.
struct Watch {
  SegmentationReport& report;
  StageTimer timer;
  StageObserver* observer; ///< null: nobody
};

/// \param labels memory for those of the image
Labelling labelPlanes(const OrganizedPoints& points, const Parameters& all_parameters,
                      Watch& watch, Workspace& workspace,
                      std::vector<std::uint16_t> labels)
{
  SegmentationReport& report = watch.report;
  StageTimer& timer = watch.timer;
  StageObserver* observer = watch.observer;
  AdaptiveParameters parameters = all_parameters.adaptive;
  const unsigned int threads = all_parameters.number_of_threads;

  // A. Planar surface detection, with tiles as large as the surfaces allow
  std::vector<TileLevel>& pyramid = workspace.pyramid;
  buildTilePyramid(points, parameters, threads, pyramid);
  const NoiseLaw noise = parameters.estimate_noise
                             ? estimateNoise(pyramid, parameters, threads)
                             : statedNoise(all_parameters.noise, pyramid, parameters);
  const double correlated = pointsPerIndependentOne(noise);
  parameters.min_points = static_cast<int>(std::min<double>(
      parameters.min_points * correlated, std::numeric_limits<int>::max()));
  parameters.min_evidence *= correlated;
  assignLocalNoise(pyramid, noise, parameters, threads);
  TileRegions regions = selectTiles(pyramid, noise, parameters, threads);
  report.tiles_tried = countTiles(pyramid);
  report.tiles_kept = regions.planes.size();
  if (observer != nullptr)
    observer->seeTiles(regions, pyramid[0]);
  timer.finish("tiles");

  // B. Merging planes, on pooled sums
  regions = mergeTouching(std::move(regions), pyramid, noise, parameters, threads);
  if (regions.planes.size() > MOST_PLANES)
    throw std::runtime_error("more than 65000 planes; raise min_points, or segment the "
                             "cloud in parts");
  if (observer != nullptr)
    observer->seeRegions(Stage::MERGED, regions, pyramid[0]);
  if (parameters.join_coplanar)
    regions = joinCoplanar(std::move(regions), points, pyramid[0], noise, parameters,
                           threads);
  if (observer != nullptr && parameters.join_coplanar)
    observer->seeRegions(Stage::JOINED, regions, pyramid[0]);
  report.planes_after_merging = regions.planes.size();
  timer.finish("merging");

  // C and D. The random field and its MAP labels, of the cells until their planes are good
  // and then of the points; and the planes fitted to them
  for (int round = 1; round < parameters.rounds; ++round) {
    regions = labelCells(regions, pyramid, noise, parameters, threads);
    if (observer != nullptr)
      observer->seeRegions(Stage::CELLS, regions, pyramid[0]);
  }
  timer.finish("cells");
  const CandidateField& field = workspace.field.field;
  buildField(points, regions, pyramid, noise, parameters, threads, workspace.field);
  if (observer != nullptr)
    observer->seeField(field, points, parameters);
  timer.finish("field");
  propagateBeliefs(field, points, parameters.passes, threads, workspace.beliefs,
                   labels);
  LabelledPoints image(std::move(labels), points.width, threads);
  report.iterations += parameters.passes;
  timer.finish("propagation");
  FittedRegions fitted =
      refineRegions(points, pyramid, regions, noise, parameters, image, threads);
  if (observer != nullptr) {
    image.write();
    observer->seeImage(Stage::REFINED, fitted, image);
  }
  dropDoubtfulPlanes(points, noise, parameters, fitted, image, threads);
  timer.finish("refinement");
  return {noise, std::move(fitted), std::move(image)};
}

/// The same of every so many-th point, and the labels of the others from theirs.
Labelling labelSampled(const OrganizedPoints& points, int every,
                       const Parameters& parameters, Watch& watch, Workspace& workspace,
                       std::vector<std::uint16_t> labels)
{
  const unsigned int threads = parameters.number_of_threads;
  const OrganizedPoints& samples = workspace.samples;
  samplePoints(points, every, threads, workspace.samples);
  watch.timer.finish("sampling");
  Labelling found =
      labelPlanes(samples, parameters, watch, workspace, std::move(workspace.labels));
  found.image.write(threads);
  spreadLabels(points, samples, found.image.labels, every, found.fitted.planes,
               found.noise, parameters.adaptive, threads, labels);
  workspace.labels = std::move(found.image.labels);
  found.image = LabelledPoints(std::move(labels), points.width, threads);
  watch.timer.finish("sampling");
  return found;
}

/// Takes the memory of the noise of a cloud before where nobody else has it.
void takeNoise(std::shared_ptr<const BlockNoise>& from, std::shared_ptr<BlockNoise>& to)
{
  if (from)
    to = std::const_pointer_cast<BlockNoise>(from);
  from.reset();
  if (to.use_count() == 1)
    std::atomic_thread_fence(std::memory_order_acquire); // all others are done with it
  else
    to.reset();
}

} // namespace

PlaneSegmentation segmentAdaptively(const OrganizedPoints& points,
                                    const Parameters& parameters)
{
  Workspace workspace;
  PlaneSegmentation result;
  segmentObserved(points, parameters, nullptr, workspace, result);
  return result;
}

void adaptive::segmentObserved(const OrganizedPoints& points,
                               const Parameters& parameters, StageObserver* observer,
                               Workspace& workspace, PlaneSegmentation& result)
{
  std::vector<std::uint16_t> labels = std::move(result.labels);
  result.tiles = {};
  result.clusters = {};
  SegmentationReport& report = result.report;
  startAnew(report);
  Watch watch = {report, StageTimer(report.stage_ms), observer};
  const int every = samplingStep(points, parameters.adaptive);
  Labelling found =
      every > 1
          ? labelSampled(points, every, parameters, watch, workspace, std::move(labels))
          : labelPlanes(points, parameters, watch, workspace, std::move(labels));
  takeNoise(result.block_noise, workspace.noise);
  if (every == 1) { // it would be of blocks of samples otherwise
    if (!workspace.noise)
      workspace.noise = std::make_shared<BlockNoise>();
    workspace.noise->assign(found.noise, workspace.pyramid[BLOCK_LEVEL]);
    result.block_noise = std::move(workspace.noise);
  }
  std::vector<Plane>& planes = workspace.regions.planes;
  planes.assign(found.fitted.planes.begin(), found.fitted.planes.end());
  const LabelRuns runs = planeRuns(found.image.runs, parameters.number_of_threads);
  gatherRegions(points, runs, {found.fitted.sums.begin(), found.fitted.sums.end()},
                parameters.min_inliers, parameters.min_area,
                parameters.number_of_threads, workspace.regions, result.regions);
  result.labels = std::move(found.image.labels);
  paintRegions(runs, result.regions, planes.size(), result.labels,
               parameters.number_of_threads);
  watch.timer.finish("regions");
  report.count(points, result.regions, parameters.number_of_threads);
}

} // namespace pcl_mrf_planes
