// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_segmentation.h>

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "adaptive/stage_observer.h"
#include "adaptive/workspace.h"
#include "region_gathering.h"
#include "stage_timer.h"
#include "threads.h"

#include <cmath>

namespace pcl_mrf_planes {

namespace {

std::vector<Plane> labelPlanes(const PlaneClusters& clusters)
{
  std::vector<Plane> planes;
  for (const PlaneModel& model : clusters.planes)
    planes.push_back(model.plane);
  return planes;
}

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
std::vector<std::uint16_t> inferLabels(const PlaneField& field,
                                       const Parameters& parameters,
                                       SegmentationReport& report)
{
  const int tolerance =
      toleranceUnits(parameters.convergence_tolerance, field.unitsPerEnergy());
  if (tolerance < 0 && !parameters.compute_energy) {
    report.iterations = parameters.iterations;
    return propagateRows(field, parameters.iterations, parameters.number_of_threads);
  }
  const GridField grid = field.toGridField();
  BeliefPropagation propagation(grid, parameters.number_of_threads);
  if (!parameters.compute_energy) {
    report.iterations = propagation.iterate(parameters.iterations, tolerance);
    return propagation.mapLabels();
  }
  std::vector<std::uint16_t> labels = propagation.mapLabels();
  report.energy.push_back(field.energy(labels));
  while (report.iterations < parameters.iterations && !propagation.settled(tolerance)) {
    report.iterations += propagation.iterate(1);
    labels = propagation.mapLabels();
    report.energy.push_back(field.energy(labels));
  }
  return labels;
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
                               const std::vector<PlaneRegion>& regions)
{
  points = organized_points.size();
  valid_points = organized_points.countValid();
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
  const ThreadTeam team(parameters.number_of_threads);
  if (parameters.method == Method::PAPER) {
    result = {}; // not two at a time
    result = segmentAsInPaper(points, parameters);
    return;
  }
  if (!workspace_)
    workspace_ = std::make_unique<adaptive::Workspace>();
  adaptive::segmentObserved(points, parameters, nullptr, *workspace_, result);
}

PlaneSegmentation segmentAsInPaper(const OrganizedPoints& points,
                                   const Parameters& parameters)
{
  PlaneSegmentation result;
  SegmentationReport& report = result.report;
  StageTimer timer(report.stage_ms);

  // A. Planar surface detection
  result.tiles = detectTilePlanes(points, parameters);
  timer.finish("tiles");

  // B. Merging planes
  result.clusters = clusterTilePlanes(result.tiles, parameters);
  timer.finish("merging");

  std::vector<std::uint16_t> map_labels;
  const std::vector<Plane> planes = labelPlanes(result.clusters);
  if (!planes.empty()) {
    // C. The Markov random field
    const PlaneField field(points, planes, parameters);
    timer.finish("field");

    // D. MRF energy optimization by belief propagation
    map_labels = inferLabels(field, parameters, report);
    timer.finish("propagation");

    result.regions = gatherRegions(points, planes, map_labels, parameters.min_inliers,
                                   parameters.min_area, parameters.number_of_threads);
  }
  result.labels = regionLabels(points, result.regions);
  timer.finish("regions");

  report.tiles_tried = result.tiles.tiles.size();
  report.tiles_kept = result.tiles.countKept();
  report.planes_after_merging = planes.size();
  report.count(points, result.regions);
  return result;
}

} // namespace pcl_mrf_planes
