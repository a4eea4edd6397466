// SPDX-License-Identifier: BSD-3-Clause
/** \file Times and memory of this library on generated rooms. Google Benchmark's options
 * choose what runs and write CSV: --benchmark_filter, --benchmark_out. */
#include "registration.h"

#include <benchmark/benchmark.h>

#include <exception>
#include <iostream>

int main(int argc, char* argv[])
{
  using namespace pcl_mrf_planes::benchmarks;
  try {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
      return 2;
    registerPipelines();
    registerFloors();
    registerPaper();
    registerInstructionSets();
    registerMemory();
    if (benchmark::RunSpecifiedBenchmarks() == 0) {
      std::cerr << "benchmark_performance: nothing matches --benchmark_filter\n";
      return 2;
    }
    return 0;
  }
  catch (const std::exception& error) {
    std::cerr << "benchmark_performance: " << error.what() << '\n';
    return 1;
  }
}
