// SPDX-License-Identifier: BSD-3-Clause
//
// Time of profile PAPER at 640x480 for a given number of labels and of iterations: the
// whole class, and the stages from the field on by the sweep, by the plain schedule, and
// by plain float code.
#include "paper_labels.h"
#include "profiles.h"
#include "registration.h"

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/row_propagation.h>

#include "reference/plain_float.h"

#include <benchmark/benchmark.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

int labelsOf(const benchmark::State& state)
{
  return static_cast<int>(state.range(0));
}

int iterationsOf(const benchmark::State& state)
{
  return static_cast<int>(state.range(1));
}

unsigned int threadsOf(const benchmark::State& state)
{
  return static_cast<unsigned int>(state.range(2));
}

void whole(benchmark::State& state)
{
  Parameters parameters = withLabels(labelsOf(state));
  parameters.iterations = iterationsOf(state);
  parameters.number_of_threads = threadsOf(state);
  ReusedSegmenter segmenter(parameters);
  segmenter.segment(roomCloud(VGA));
  const auto labels = segmenter.segmentation.getReport().planes_after_merging;
  if (labels != static_cast<std::size_t>(labelsOf(state)))
    state.SkipWithError("the scene gives another number of labels");
  for (auto _ : state)
    segmenter.segment(roomCloud(VGA));
}

void sweep(benchmark::State& state)
{
  const Parameters parameters = withLabels(labelsOf(state));
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(roomPoints(VGA), planes, parameters);
    benchmark::DoNotOptimize(
        propagateRows(field, iterationsOf(state), threadsOf(state)));
  }
}

void plainSchedule(benchmark::State& state)
{
  const Parameters parameters = withLabels(labelsOf(state));
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(roomPoints(VGA), planes, parameters);
    const GridField grid = field.toGridField();
    BeliefPropagation propagation(grid);
    propagation.iterate(iterationsOf(state));
    benchmark::DoNotOptimize(propagation.mapLabels());
  }
}

void plainFloat(benchmark::State& state)
{
  const Parameters parameters = withLabels(labelsOf(state));
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(roomPoints(VGA), planes, parameters);
    benchmark::DoNotOptimize(
        reference::plainFloatLabels(field, roomPoints(VGA), iterationsOf(state)));
  }
}

using Work = void (*)(benchmark::State&);

benchmark::internal::Benchmark* registerWork(const char* name, Work work)
{
  return benchmark::RegisterBenchmark(name, work)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->ArgNames({"labels", "iterations", "threads"});
}

} // namespace

void registerPaper()
{
  benchmark::internal::Benchmark* all = registerWork("paper/whole", whole);
  for (const int labels : {2, 4, 10, 16, 40})
    for (const int iterations : {1, 5, 20})
      all->Args({labels, iterations, 1});
  all->Args({10, 5, 2});
  registerWork("paper/sweep", sweep)
      ->Args({10, 5, 1})
      ->Args({10, 5, 2})
      ->Args({40, 5, 1});
  registerWork("paper/plain_schedule", plainSchedule)
      ->Args({10, 5, 1})
      ->Args({40, 5, 1});
  registerWork("paper/plain_float", plainFloat)->Args({10, 5, 1});
}

} // namespace pcl_mrf_planes::benchmarks
