// SPDX-License-Identifier: BSD-3-Clause
//
// Clouds of any size and any numbers through the class: every profile, and all that can
// be asked afterwards.
//
// Bytes: profile and switches, width, height, shape, then what replaces single points.
#include "fuzz_class.h"

#include <cstdint>

namespace pcl_mrf_planes::fuzz {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// Something with planes in it, for the bytes to spoil.
pcl::PointXYZ basePoint(int shape, int u, int v, int width)
{
  const auto x = static_cast<float>(u) * 0.01f;
  const auto y = static_cast<float>(v) * 0.01f;
  switch (shape % 6) {
  case 0:
    return {x, y, 2.0f};
  case 1: // a corner
    return {x, y, u < width / 2 ? 2.0f : 2.0f + x};
  case 2: // stairs
    return {x, y, 1.0f + 0.2f * std::floor(static_cast<float>(v) / 12.0f)};
  case 3: // a curved surface
    return {x, y, 2.0f + x * x + y * y};
  case 4: // all alike
    return {1.0f, 1.0f, 1.0f};
  default: // with a full turn, as a lidar sees it
    return {std::cos(x * 6.0f), std::sin(x * 6.0f), y};
  }
}

/// Runs of points that are replaced: where, how many, with what.
void spoil(Bytes& bytes, Cloud& cloud)
{
  while (bytes.left() > 0 && !cloud.empty()) {
    const std::size_t first = bytes.take<std::uint16_t>() % cloud.size();
    const std::size_t count = 1 + bytes.byte() % 64U;
    const std::size_t stride = 1 + bytes.byte() % 8U;
    const int axes = bytes.byte();
    const auto value = static_cast<float>(bytes.hostile());
    for (std::size_t k = 0, i = first; k < count && i < cloud.size();
         ++k, i += stride) {
      if ((axes & 1) != 0)
        cloud[i].x = value;
      if ((axes & 2) != 0)
        cloud[i].y = value;
      if ((axes & 4) != 0)
        cloud[i].z += value;
    }
  }
}

Cloud::Ptr makeCloud(Bytes& bytes)
{
  const int width = bytes.within(0, 48);
  const int height = bytes.within(0, 48);
  const int shape = bytes.byte();
  Cloud::Ptr cloud(new Cloud);
  cloud->width = static_cast<std::uint32_t>(width);
  cloud->height = static_cast<std::uint32_t>(height);
  cloud->is_dense = bytes.flag();
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      cloud->points.push_back(basePoint(shape, u, v, width));
  if (bytes.flag())
    cloud->sensor_origin_ = Eigen::Vector4f(static_cast<float>(bytes.hostile()),
                                            static_cast<float>(bytes.hostile()), 0, 0);
  if (bytes.flag())
    cloud->sensor_orientation_ = Eigen::Quaternionf(
        static_cast<float>(bytes.hostile()), static_cast<float>(bytes.hostile()), 0, 0);
  if (bytes.byte() == 255) // says another size than it has
    cloud->width += 1;
  spoil(bytes, *cloud);
  return cloud;
}

void run(Bytes bytes)
{
  Segmentation segmentation;
  segmentation.setProfile(static_cast<Profile>(bytes.byte() % 3));
  const int switches = bytes.byte();
  segmentation.setSeparatePatches((switches & 1) != 0);
  segmentation.setProjectPoints((switches & 2) != 0);
  segmentation.setSimplifyContours((switches & 4) != 0);
  if ((switches & 8) != 0)
    segmentation.setTileSize(8, 8);
  if ((switches & 16) != 0) {
    Parameters parameters = segmentation.getParameters();
    parameters.adaptive.min_points = 1;
    parameters.adaptive.min_evidence = 0.0;
    segmentation.setParameters(parameters);
  }
  segmentSoundly(segmentation, makeCloud(bytes));
  if ((switches & 32) != 0) {
    Segmentation::PlanarRegions regions;
    segmentation.segment(regions);
  }
}

} // namespace
} // namespace pcl_mrf_planes::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pcl_mrf_planes::fuzz::run({data, size});
  return 0;
}
