// SPDX-License-Identifier: BSD-3-Clause
#include "paper_labels.h"
#include "profiles.h"
#include "registration.h"

#include <benchmark/benchmark.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

/// Planes and labels are stated as well: what a time is worth depends on them. (Counters
/// of its own in some benchmarks only would break the CSV of Google Benchmark.)
void pipeline(benchmark::State& state, Parameters parameters, const ImageShape& shape)
{
  parameters.number_of_threads = static_cast<unsigned int>(state.range(0));
  const Cloud::ConstPtr& cloud = roomCloud(shape);
  ReusedSegmenter segmenter(parameters);
  segmenter.segment(cloud); // memory of the first frame
  for (auto _ : state)
    segmenter.segment(cloud);
  const auto& report = segmenter.segmentation.getReport();
  state.SetLabel("planes:" + std::to_string(report.planes) +
                 " labels:" + std::to_string(report.planes_after_merging));
}

void registerPipeline(const char* name, const Parameters& parameters,
                      const ImageShape& shape)
{
  benchmark::RegisterBenchmark(
      ("pipeline/" + std::string(name) + '/' + shape.name()).c_str(), pipeline,
      parameters, shape)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2);
}

/// As many labels at any size: its tiles take the same part of the picture.
Parameters tenLabels(const ImageShape& shape)
{
  Parameters parameters = withLabels(10);
  if (!shape.lidar)
    parameters.tile_width = parameters.tile_height =
        parameters.tile_width * shape.width / VGA.width;
  return parameters;
}

} // namespace

void registerPipelines()
{
  for (const ImageShape& shape : allShapes()) {
    for (const NamedProfile& profile : allProfiles())
      registerPipeline(profile.name, Parameters::fromProfile(profile.profile), shape);
    registerPipeline("PAPER_10_LABELS", tenLabels(shape), shape);
  }
}

} // namespace pcl_mrf_planes::benchmarks
