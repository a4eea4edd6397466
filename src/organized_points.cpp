// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/organized_points.h>

namespace pcl_mrf_planes {

void OrganizedPoints::resize(int new_width, int new_height)
{
  width = new_width;
  height = new_height;
  const std::size_t count =
      static_cast<std::size_t>(new_width) * static_cast<std::size_t>(new_height);
  x.assign(count, 0.0f);
  y.assign(count, 0.0f);
  z.assign(count, 0.0f);
  valid.assign(count, 0);
}

const float* OrganizedPoints::depthRow(int row, std::vector<float>& storage) const
{
  const std::size_t start =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
  if (depth_measure != DepthMeasure::RANGE)
    return &z[start];
  storage.resize(static_cast<std::size_t>(width));
  for (std::size_t i = 0; i < storage.size(); ++i)
    storage[i] = depth(start + i);
  return storage.data();
}

void OrganizedPoints::resolveDepthMeasure(DepthMeasure wanted)
{
  depth_measure = wanted;
  if (wanted != DepthMeasure::AUTO)
    return;
  std::size_t points = 0;
  std::size_t behind = 0;
  for (std::size_t i = 0; i < valid.size(); ++i) {
    points += valid[i];
    behind += valid[i] & static_cast<std::uint8_t>(z[i] <= 0.0f);
  }
  depth_measure =
      behind * 100 > points ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS;
}

std::size_t OrganizedPoints::countValid() const
{
  std::size_t points = 0;
  for (const std::uint8_t is_valid : valid)
    points += is_valid;
  return points;
}

} // namespace pcl_mrf_planes
