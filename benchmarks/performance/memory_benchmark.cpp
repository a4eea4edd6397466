// SPDX-License-Identifier: BSD-3-Clause
//
// Memory of an object that is used for one frame after the other. The first frame and the
// life of the object are counted apart.
#include "allocation_count.h"
#include "image_shape.h"
#include "profiles.h"
#include "registration.h"
#include "resident_memory.h"

#include <benchmark/benchmark.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr int FRAMES = 3;

benchmark::Counter number(std::int64_t value)
{
  return benchmark::Counter(static_cast<double>(value));
}

/// All that an object takes, outputs included, from its making on.
void measureLife(benchmark::State& state, Profile profile, const Cloud::ConstPtr& cloud)
{
  const ResidentPeak resident;
  const AllocationCount count;
  ReusedSegmenter segmenter(Parameters::fromProfile(profile));
  for (int frame = 0; frame < FRAMES; ++frame)
    segmenter.segment(cloud);
  state.counters["most_held_bytes"] = number(count.mostHeld());
  state.counters["kept_bytes"] = number(count.held());
  state.counters["resident_bytes"] = number(resident.bytes());
}

void measureFrame(benchmark::State& state, Profile profile,
                  const Cloud::ConstPtr& cloud)
{
  ReusedSegmenter segmenter(Parameters::fromProfile(profile));
  segmenter.segment(cloud);
  segmenter.segment(cloud);
  const AllocationCount count;
  for (int frame = 0; frame < FRAMES; ++frame)
    segmenter.segment(cloud);
  state.counters["frame_allocations"] = number(count.allocations() / FRAMES);
  state.counters["frame_bytes"] = number(count.bytes() / FRAMES);
}

void memory(benchmark::State& state, Profile profile, const ImageShape& shape)
{
  const Cloud::ConstPtr& cloud = roomCloud(shape);
  for (auto _ : state) {
    measureLife(state, profile, cloud);
    measureFrame(state, profile, cloud);
  }
  state.counters["cloud_bytes"] =
      number(static_cast<std::int64_t>(cloud->size() * sizeof(pcl::PointXYZ)));
}

} // namespace

void registerMemory()
{
  for (const NamedProfile& profile : allProfiles())
    for (const ImageShape& shape : allShapes())
      benchmark::RegisterBenchmark(
          ("memory/" + std::string(profile.name) + '/' + shape.name()).c_str(), memory,
          profile.profile, shape)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(1)
          ->Repetitions(1);
}

} // namespace pcl_mrf_planes::benchmarks
