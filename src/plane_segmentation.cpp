// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_segmentation.h>

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "adaptive/stage_observer.h"
#include "frame_memory.h"
#include "paper_stages.h"
#include "region_gathering.h"
#include "segmenter_memory.h"
#include "stage_timer.h"
#include "threads.h"

#include <cmath>
#include <utility>

namespace pcl_mrf_planes {

namespace {

/// The tolerance in 16-bit units; -1 for never.
int toleranceUnits(double tolerance, double units_per_energy)
{
  return tolerance < 0.0
             ? -1
             : static_cast<int>(std::fmin(65535.0, tolerance * units_per_energy));
}

/// MAP labels by belief propagation, section IV-D. Where nothing is asked for between
/// the iterations they run row by row; otherwise one after the other. The labels are
/// the same.
void inferLabels(const PlaneField& field, const Parameters& parameters,
                 SegmentationReport& report, std::vector<std::uint16_t>& labels)
{
  const int tolerance =
      toleranceUnits(parameters.convergence_tolerance, field.unitsPerEnergy());
  if (tolerance < 0 && !parameters.compute_energy) {
    report.iterations = parameters.iterations;
    propagateRows(field, parameters.iterations, parameters.number_of_threads, labels);
    return;
  }
  const GridField grid = field.toGridField();
  BeliefPropagation propagation(grid, parameters.number_of_threads);
  if (!parameters.compute_energy) {
    report.iterations = propagation.iterate(parameters.iterations, tolerance);
    labels = propagation.mapLabels();
    return;
  }
  labels = propagation.mapLabels();
  report.energy.push_back(field.energy(labels));
  while (report.iterations < parameters.iterations && !propagation.settled(tolerance)) {
    report.iterations += propagation.iterate(1);
    labels = propagation.mapLabels();
    report.energy.push_back(field.energy(labels));
  }
}

/// C and D: the Markov random field of the planes, in the memory of the one before, and MAP
/// labels by it.
void labelPoints(const OrganizedPoints& points, const Parameters& parameters,
                 PaperMemory& memory, StageTimer& timer, PlaneSegmentation& result)
{
  const std::vector<Plane>& planes = memory.regions.planes;
  if (memory.field)
    memory.field.emplace(
        PlaneField(points, planes, parameters, std::move(*memory.field)));
  else
    memory.field.emplace(points, planes, parameters);
  timer.finish("field");
  inferLabels(*memory.field, parameters, result.report, result.labels);
  timer.finish("propagation");
}

/// Section IV of the paper.
void segmentAsInPaper(const OrganizedPoints& points, const Parameters& parameters,
                      PaperMemory& memory, PlaneSegmentation& result)
{
  SegmentationReport& report = result.report;
  startAnew(report);
  result.block_noise.reset();
  StageTimer timer(report.stage_ms);

  // A. Planar surface detection
  detectTilePlanes(points, parameters, result.tiles);
  timer.finish("tiles");

  // B. Merging planes
  clusterTilePlanes(result.tiles, parameters, result.clusters);
  std::vector<Plane>& planes = memory.regions.planes;
  planes.clear();
  for (const PlaneModel& model : result.clusters.planes)
    planes.push_back(model.plane);
  timer.finish("merging");

  if (planes.empty())
    result.labels.assign(points.size(), NO_PLANE);
  else
    labelPoints(points, parameters, memory, timer, result);
  gatherRegions(points, parameters.min_inliers, parameters.min_area,
                parameters.number_of_threads, result.labels, memory.regions,
                result.regions);
  regionLabels(points, result.regions, result.labels);
  timer.finish("regions");

  report.tiles_tried = result.tiles.tiles.size();
  report.tiles_kept = result.tiles.countKept();
  report.planes_after_merging = planes.size();
  report.count(points, result.regions, parameters.number_of_threads);
}

} // namespace

double SegmentationReport::totalMs() const
{
  double total = 0.0;
  for (const auto& stage : stage_ms)
    total += stage.second;
  return total;
}

void SegmentationReport::count(const OrganizedPoints& organized_points,
                               const std::vector<PlaneRegion>& regions,
                               unsigned int threads)
{
  points = organized_points.size();
  valid_points = organized_points.countValid(threads);
  planes = regions.size();
  std::size_t labelled = 0;
  for (const PlaneRegion& region : regions)
    labelled += region.indices.size();
  if (valid_points > 0)
    labelled_share = static_cast<double>(labelled) / static_cast<double>(valid_points);
}

PlaneSegmentation segmentPlanes(const OrganizedPoints& points,
                                const Parameters& parameters)
{
  PlaneSegmentation result;
  PlaneSegmenter().segment(points, parameters, result);
  return result;
}

PlaneSegmenter::PlaneSegmenter() = default;
PlaneSegmenter::PlaneSegmenter(const PlaneSegmenter& /*other*/) {}
PlaneSegmenter::PlaneSegmenter(PlaneSegmenter&& other) noexcept = default;
PlaneSegmenter& PlaneSegmenter::operator=(const PlaneSegmenter& /*other*/)
{
  return *this; // each has memory of its own
}
PlaneSegmenter& PlaneSegmenter::operator=(PlaneSegmenter&& other) noexcept = default;
PlaneSegmenter::~PlaneSegmenter() = default;

void PlaneSegmenter::segment(const OrganizedPoints& points,
                             const Parameters& parameters, PlaneSegmentation& result)
{
  if (!memory_)
    memory_ = std::make_unique<SegmenterMemory>();
  const ThreadTeam team(parameters.number_of_threads);
  const FrameMemoryScope scope(&memory_->frame);
  if (parameters.method == Method::PAPER)
    segmentAsInPaper(points, parameters, memory_->paper, result);
  else
    adaptive::segmentObserved(points, parameters, nullptr, memory_->adaptive, result);
}

PlaneSegmentation segmentAsInPaper(const OrganizedPoints& points,
                                   const Parameters& parameters)
{
  PaperMemory memory;
  PlaneSegmentation result;
  segmentAsInPaper(points, parameters, memory, result);
  return result;
}

} // namespace pcl_mrf_planes
