// SPDX-License-Identifier: BSD-3-Clause
#include "image_shape.h"
#include "profiles.h"
#include "registration.h"

#include <benchmark/benchmark.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

void pipeline(benchmark::State& state, Profile profile, const ImageShape& shape)
{
  Parameters parameters = Parameters::fromProfile(profile);
  parameters.number_of_threads = static_cast<unsigned int>(state.range(0));
  const Cloud::ConstPtr& cloud = roomCloud(shape);
  ReusedSegmenter segmenter(parameters);
  segmenter.segment(cloud); // memory of the first frame
  if (segmenter.planes.empty())
    state.SkipWithError("no planes");
  for (auto _ : state)
    segmenter.segment(cloud);
  state.SetItemsProcessed(state.iterations() * static_cast<long>(cloud->size()));
}

} // namespace

void registerPipelines()
{
  for (const NamedProfile& profile : allProfiles())
    for (const ImageShape& shape : allShapes())
      benchmark::RegisterBenchmark(
          ("pipeline/" + std::string(profile.name) + '/' + shape.name()).c_str(),
          pipeline, profile.profile, shape)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->ArgName("threads")
          ->Arg(1)
          ->Arg(2);
}

} // namespace pcl_mrf_planes::benchmarks
