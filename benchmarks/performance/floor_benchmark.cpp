// SPDX-License-Identifier: BSD-3-Clause
//
// What any method that looks at every point has to pay: reading the cloud, reading it into
// planes, and gathering the sums that planes are fitted from.
#include "cell_sums.h"
#include "image_shape.h"
#include "registration.h"

#include <Eigen/Core>
#include <benchmark/benchmark.h>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr std::size_t STRIDE = sizeof(pcl::PointXYZ) / sizeof(float);

/// Sum of all the numbers of the cloud, in several chains so that memory is the limit.
void readCloud(benchmark::State& state, const ImageShape& shape)
{
  const Cloud& cloud = *roomCloud(shape);
  constexpr std::size_t CHAINS = 8;
  for (auto _ : state) {
    Eigen::Array4f sums[CHAINS];
    for (Eigen::Array4f& sum : sums)
      sum.setZero();
    for (std::size_t i = 0; i + CHAINS <= cloud.size(); i += CHAINS)
      for (std::size_t k = 0; k < CHAINS; ++k)
        sums[k] += cloud[i + k].getArray4fMap();
    benchmark::DoNotOptimize(sums);
  }
}

void loadPlanes(benchmark::State& state, const ImageShape& shape)
{
  const Cloud& cloud = *roomCloud(shape);
  OrganizedPoints points;
  for (auto _ : state) {
    points.load(shape.width, shape.height, cloud[0].data, STRIDE);
    benchmark::ClobberMemory();
  }
}

void gatherSums(benchmark::State& state, const ImageShape& shape)
{
  const OrganizedPoints& points = roomPoints(shape);
  std::vector<adaptive::TileSums> sums;
  for (auto _ : state) {
    sumAllCells(points, sums);
    benchmark::ClobberMemory();
  }
}

using Pass = void (*)(benchmark::State&, const ImageShape&);

void registerFloor(const std::string& name, Pass pass)
{
  for (const ImageShape& shape : allShapes())
    benchmark::RegisterBenchmark(("floor/" + name + '/' + shape.name()).c_str(), pass,
                                 shape)
        ->Unit(benchmark::kMillisecond);
}

} // namespace

void registerFloors()
{
  registerFloor("read", readCloud);
  registerFloor("load", loadPlanes);
  registerFloor("sums", gatherSums);
}

} // namespace pcl_mrf_planes::benchmarks
