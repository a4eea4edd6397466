// SPDX-License-Identifier: BSD-3-Clause
//
// Time of profile PAPER at 640x480 and 5 iterations for a given number of labels: the
// stages from the field on, by the sweep, by the plain schedule, and by plain float
// code.
#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "reference/plain_float.h"
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <benchmark/benchmark.h>

#include <stdexcept>

namespace {

using namespace pcl_mrf_planes;

constexpr int ITERATIONS = 5;

/// A room as a Kinect sees it, 640x480.
const OrganizedPoints& room()
{
  static const OrganizedPoints points = [] {
    const scenes::View view = scenes::makeRoom(1);
    const scenes::SceneFrame frame =
        scenes::render(view.scene, view.camera, scenes::SensorNoise::kinect(), 1);
    OrganizedPoints result;
    result.resize(frame.width, frame.height);
    for (std::size_t i = 0; i < result.size(); ++i)
      result.set(i, frame.x[i], frame.y[i], frame.z[i]);
    return result;
  }();
  return points;
}

/// Section V, but merging less, so that the scene gives as many labels as asked for.
Parameters withLabels(int labels)
{
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.merge_threshold = 0.01;
  parameters.tile_width = parameters.tile_height = 20;
  parameters.noise_multiplier = 3.0;
  parameters.max_planes = labels;
  return parameters;
}

std::vector<Plane> labelPlanes(const Parameters& parameters)
{
  const PlaneClusters clusters =
      clusterTilePlanes(detectTilePlanes(room(), parameters), parameters);
  if (static_cast<int>(clusters.planes.size()) != parameters.max_planes)
    throw std::runtime_error("the scene gives fewer labels than the benchmark needs");
  std::vector<Plane> planes;
  for (const PlaneModel& model : clusters.planes)
    planes.push_back(model.plane);
  return planes;
}

void sweep(benchmark::State& state)
{
  const Parameters parameters = withLabels(static_cast<int>(state.range(0)));
  const std::vector<Plane> planes = labelPlanes(parameters);
  const auto threads = static_cast<unsigned int>(state.range(1));
  for (auto _ : state) {
    const PlaneField field(room(), planes, parameters);
    benchmark::DoNotOptimize(propagateRows(field, ITERATIONS, threads));
  }
}
BENCHMARK(sweep)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgNames({"labels", "threads"})
    ->Args({4, 1})
    ->Args({10, 1})
    ->Args({10, 2})
    ->Args({16, 1})
    ->Args({40, 1});

void plainSchedule(benchmark::State& state)
{
  const Parameters parameters = withLabels(static_cast<int>(state.range(0)));
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(room(), planes, parameters);
    const GridField grid = field.toGridField();
    BeliefPropagation propagation(grid);
    propagation.iterate(ITERATIONS);
    benchmark::DoNotOptimize(propagation.mapLabels());
  }
}
BENCHMARK(plainSchedule)
    ->Unit(benchmark::kMillisecond)
    ->ArgName("labels")
    ->Arg(10)
    ->Arg(40);

void plainFloat(benchmark::State& state)
{
  const Parameters parameters = withLabels(static_cast<int>(state.range(0)));
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(room(), planes, parameters);
    benchmark::DoNotOptimize(reference::plainFloatLabels(field, room(), ITERATIONS));
  }
}
BENCHMARK(plainFloat)->Unit(benchmark::kMillisecond)->ArgName("labels")->Arg(10);

/// The whole profile with 10 labels, tiles to regions.
void wholePipeline(benchmark::State& state)
{
  Parameters parameters = withLabels(10);
  parameters.number_of_threads = static_cast<unsigned int>(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(segmentPlanes(room(), parameters).labels);
}
BENCHMARK(wholePipeline)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->ArgName("threads")
    ->Arg(1)
    ->Arg(2);

} // namespace
