// SPDX-License-Identifier: BSD-3-Clause
//
// The results are the same bits on every instruction set; here is what each of them gives.
#include "cell_sums.h"
#include "paper_labels.h"
#include "profiles.h"
#include "registration.h"

#include <pcl_mrf_planes/row_propagation.h>

#include <benchmark/benchmark.h>
#include <hwy/targets.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

/// The kernels run on this instruction set while an object lives.
class ChosenInstructionSet {
public:
  explicit ChosenInstructionSet(std::int64_t target)
  {
    hwy::SetSupportedTargetsForTest(target);
  }
  ~ChosenInstructionSet() { hwy::SetSupportedTargetsForTest(0); }
  ChosenInstructionSet(const ChosenInstructionSet&) = delete;
  ChosenInstructionSet& operator=(const ChosenInstructionSet&) = delete;
};

void load(benchmark::State& state, std::int64_t target)
{
  const ChosenInstructionSet chosen(target);
  const Cloud& cloud = *roomCloud(VGA);
  OrganizedPoints points;
  for (auto _ : state) {
    points.load(VGA.width, VGA.height, cloud[0].data, sizeof(cloud[0]) / sizeof(float));
    benchmark::ClobberMemory();
  }
}

void sums(benchmark::State& state, std::int64_t target)
{
  const ChosenInstructionSet chosen(target);
  const OrganizedPoints& points = roomPoints(VGA);
  std::vector<adaptive::TileSums> cells;
  for (auto _ : state) {
    sumAllCells(points, cells);
    benchmark::ClobberMemory();
  }
}

/// Field and propagation of profile PAPER with 10 labels and 5 iterations.
void sweep(benchmark::State& state, std::int64_t target)
{
  const ChosenInstructionSet chosen(target);
  const Parameters parameters = withLabels(10);
  const std::vector<Plane> planes = labelPlanes(parameters);
  for (auto _ : state) {
    const PlaneField field(roomPoints(VGA), planes, parameters);
    benchmark::DoNotOptimize(propagateRows(field, parameters.iterations));
  }
}

void profileOn(benchmark::State& state, std::int64_t target, Profile profile)
{
  const ChosenInstructionSet chosen(target);
  ReusedSegmenter segmenter(Parameters::fromProfile(profile));
  segmenter.segment(roomCloud(VGA));
  for (auto _ : state)
    segmenter.segment(roomCloud(VGA));
}

std::string nameOf(const std::string& what, std::int64_t target)
{
  return "instructions/" + what + '/' + hwy::TargetName(target);
}

} // namespace

void registerInstructionSets()
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    const auto add = [&](const char* what,
                         void (*work)(benchmark::State&, std::int64_t)) {
      benchmark::RegisterBenchmark(nameOf(what, target).c_str(), work, target)
          ->Unit(benchmark::kMillisecond);
    };
    add("load", load);
    add("sums", sums);
    add("sweep", sweep);
    for (const NamedProfile& profile : allProfiles())
      benchmark::RegisterBenchmark(nameOf(profile.name, target).c_str(), profileOn,
                                   target, profile.profile)
          ->Unit(benchmark::kMillisecond);
  }
}

} // namespace pcl_mrf_planes::benchmarks
