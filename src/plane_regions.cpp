// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_regions.h>

#include <pcl_mrf_planes/scatter_matrix.h>

#include "adaptive/tile_sums_kernel.h"
#include "frame_memory.h"
#include "region_area.h"
#include "region_gathering.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

namespace pcl_mrf_planes {

namespace {

/// Leaves the labels of the points that were measured; NO_PLANE for the others.
void keepValid(const OrganizedPoints& points, unsigned int threads,
               std::vector<std::uint16_t>& labels)
{
  const auto width = static_cast<std::size_t>(points.width);
  parallelRows(points.height, threads, [&](int row) {
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    for (std::size_t i = begin; i < begin + width; ++i)
      labels[i] = points.valid[i] != 0 ? labels[i] : NO_PLANE;
  });
}

/// Points of each label.
FrameVector<std::size_t> countPoints(const LabelRuns& image, std::size_t labels)
{
  FrameVector<std::size_t> counts(labels, 0);
  for (const LabelRun& run : image.runs)
    counts[run.label] += run.end - run.begin;
  return counts;
}

/// Ten sums of a run, in four columns as those of a tile.
ScatterMatrix sumRun(const OrganizedPoints& points, const LabelRun& run)
{
  constexpr std::size_t COLUMNS = 4;
  const std::size_t rows = (run.end - run.begin) / COLUMNS;
  adaptive::TileSums sums;
  if (rows > 0)
    adaptive::sumTiles({&points.x[run.begin], &points.y[run.begin],
                        &points.z[run.begin], &points.valid[run.begin], COLUMNS,
                        static_cast<int>(rows)},
                       1, &sums);
  sums.n = static_cast<double>(rows * COLUMNS);
  for (std::size_t i = run.begin + rows * COLUMNS; i < run.end; ++i)
    sums.add(points.x[i], points.y[i], points.z[i]);
  return sums;
}

/// Ten sums of the points of each label.
FrameVector<ScatterMatrix> sumLabels(const OrganizedPoints& points, std::size_t count,
                                     const LabelRuns& image, unsigned int threads)
{
  return sumOfBands(
      static_cast<int>(image.rows.size()) - 1, threads,
      FrameVector<ScatterMatrix>(count),
      [&](int first, int last, FrameVector<ScatterMatrix>& sums) {
        const std::size_t end = image.rows[static_cast<std::size_t>(last)];
        for (std::size_t k = image.rows[static_cast<std::size_t>(first)]; k < end; ++k)
          sums[image.runs[k].label] += sumRun(points, image.runs[k]);
      });
}

PlaneRegion makeRegion(const Plane& plane, std::size_t label, double area,
                       const ScatterMatrix& scatter)
{
  PlaneRegion region;
  region.plane = plane;
  region.label = static_cast<int>(label);
  region.area = area;
  region.rms = scatter.rmsDistance(plane);
  region.centroid = scatter.centroid();
  region.covariance = scatter.covariance();
  return region;
}

/// Takes the indices of all regions.
void takeIndices(std::vector<PlaneRegion>& regions,
                 std::vector<std::vector<int>>& indices)
{
  for (PlaneRegion& region : regions)
    indices.push_back(std::move(region.indices));
}

/// Gives the regions with the most points the largest of the vectors: as a cloud is like the
/// one before, so are the sizes.
void giveIndices(const FrameVector<std::size_t>& counts, RegionMemory& memory,
                 std::vector<PlaneRegion>& regions)
{
  std::vector<std::vector<int>>& indices = memory.indices;
  std::sort(indices.begin(), indices.end(),
            [](const std::vector<int>& a, const std::vector<int>& b) {
              return a.capacity() < b.capacity();
            });
  const auto points = [&](const PlaneRegion* region) {
    return counts[static_cast<std::size_t>(region->label)];
  };
  FrameVector<PlaneRegion*> largest_first;
  for (PlaneRegion& region : regions)
    largest_first.push_back(&region);
  std::sort(largest_first.begin(), largest_first.end(),
            [&](const PlaneRegion* a, const PlaneRegion* b) {
              return points(a) > points(b);
            });
  for (PlaneRegion* region : largest_first)
    if (!indices.empty()) {
      region->indices = std::move(indices.back());
      indices.pop_back();
    }
  // More are of no use, should other results than the last one come in.
  memory.most_regions = std::max(memory.most_regions, regions.size());
  if (indices.size() > memory.most_regions)
    indices.resize(memory.most_regions);
}

/// Points of the runs of each label that has a region.
void fillIndices(const LabelRuns& image, const FrameVector<std::size_t>& counts,
                 unsigned int threads, std::vector<PlaneRegion>& regions)
{
  FrameVector<PlaneRegion*> of_label(counts.size(), nullptr);
  for (PlaneRegion& region : regions)
    of_label[static_cast<std::size_t>(region.label)] = &region;
  // Where the points of each run belong among those of its label.
  FrameVector<std::size_t> place;
  place.reserve(image.runs.size());
  FrameVector<std::size_t> filled(counts.size(), 0);
  for (const LabelRun& run : image.runs) {
    place.push_back(filled[run.label]);
    filled[run.label] += run.end - run.begin;
  }
  parallelParts(static_cast<int>(regions.size()), threads, [&](int k) {
    PlaneRegion& region = regions[static_cast<std::size_t>(k)];
    region.indices.resize(counts[static_cast<std::size_t>(region.label)]);
  });
  forEachRun(image, threads, [&](std::size_t k) {
    const LabelRun& run = image.runs[k];
    if (PlaneRegion* region = of_label[run.label])
      std::iota(&region->indices[place[k]],
                &region->indices[place[k]] + (run.end - run.begin),
                static_cast<int>(run.begin));
  });
}

/// Largest area first; then most points; then the first point.
auto rank(const PlaneRegion& region)
{
  return std::make_tuple(-region.area, -static_cast<double>(region.indices.size()),
                         region.indices.front());
}

} // namespace

std::vector<PlaneRegion> gatherRegions(const OrganizedPoints& points,
                                       const std::vector<Plane>& planes,
                                       const std::vector<std::uint16_t>& labels,
                                       int min_points, double min_area)
{
  std::vector<std::uint16_t> own = labels;
  RegionMemory memory = {planes, {}, 0};
  std::vector<PlaneRegion> regions;
  gatherRegions(points, min_points, min_area, 1, own, memory, regions);
  return regions;
}

void gatherRegions(const OrganizedPoints& points, int min_points, double min_area,
                   unsigned int threads, std::vector<std::uint16_t>& labels,
                   RegionMemory& memory, std::vector<PlaneRegion>& regions)
{
  keepValid(points, threads, labels);
  const LabelRuns image = findRuns(labels, points.width, NO_PLANE, threads);
  gatherRegions(points, image, sumLabels(points, memory.planes.size(), image, threads),
                min_points, min_area, threads, memory, regions);
}

void gatherRegions(const OrganizedPoints& points, const LabelRuns& image,
                   const FrameVector<ScatterMatrix>& scatter, int min_points,
                   double min_area, unsigned int threads, RegionMemory& memory,
                   std::vector<PlaneRegion>& regions)
{
  const std::vector<Plane>& planes = memory.planes;
  const FrameVector<std::size_t> counts = countPoints(image, planes.size());
  const FrameVector<double> areas = meshAreas(points, planes, image, threads);
  takeIndices(regions, memory.indices);
  regions.clear();
  for (std::size_t l = 0; l < planes.size(); ++l)
    if (counts[l] > 0 && areas[l] >= min_area &&
        counts[l] >= static_cast<std::size_t>(std::max(min_points, 0)))
      regions.push_back(makeRegion(planes[l], l, areas[l], scatter[l]));
  giveIndices(counts, memory, regions);
  fillIndices(image, counts, threads, regions);
  std::sort(
      regions.begin(), regions.end(),
      [](const PlaneRegion& p, const PlaneRegion& q) { return rank(p) < rank(q); });
}

void paintRegions(const LabelRuns& image, const std::vector<PlaneRegion>& regions,
                  std::size_t planes, std::vector<std::uint16_t>& labels,
                  unsigned int threads)
{
  FrameVector<std::uint16_t> number(planes, 0);
  for (std::size_t k = 0; k < regions.size(); ++k)
    number[static_cast<std::size_t>(regions[k].label)] =
        static_cast<std::uint16_t>(k + 1);
  forEachRun(image, threads, [&](std::size_t k) {
    fillRun(image.runs[k], number[image.runs[k].label], labels);
  });
}

std::vector<std::uint16_t> regionLabels(const OrganizedPoints& points,
                                        const std::vector<PlaneRegion>& regions)
{
  std::vector<std::uint16_t> image;
  regionLabels(points, regions, image);
  return image;
}

void regionLabels(const OrganizedPoints& points,
                  const std::vector<PlaneRegion>& regions,
                  std::vector<std::uint16_t>& labels)
{
  labels.assign(points.size(), 0);
  for (const LabelRun& run : runsOfRegions(regions, points.width))
    fillRun(run, run.label, labels);
}

} // namespace pcl_mrf_planes
