// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/organized_points.h>

#include "organized_points_kernel.h"
#include "threads.h"

#include <algorithm>
#include <cstring>

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

void OrganizedPoints::load(int new_width, int new_height, const float* first,
                           std::size_t stride, unsigned int threads)
{
  setSize(new_width, new_height);
  const ThreadTeam team(threads);
  const Bands bands(height);
  parallelParts(bands.count, threads, [&](int band) {
    const auto start = [&](int b) {
      return static_cast<std::size_t>(bands.begin(b)) * static_cast<std::size_t>(width);
    };
    std::size_t i = start(band);
    const std::size_t end = start(band + 1);
    i += loadPoints(first + i * stride, stride, end - i,
                    {&x[i], &y[i], &z[i], &valid[i]});
    for (; i < end; ++i) {
      const float* point = first + i * stride;
      set(i, point[0], point[1], point[2]);
    }
  });
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
  // Some rows tell it: a laser scanner that sees behind itself does so in all of them.
  constexpr std::size_t STEP = 4;
  const auto columns = static_cast<std::size_t>(width);
  std::uint32_t points = 0; // fewer than 2^31
  std::uint32_t in_front = 0;
  for (std::size_t row = 0; row < valid.size(); row += STEP * columns)
    for (std::size_t i = row; i < row + columns; ++i) {
      points += valid[i];
      in_front += z[i] > 0.0f ? 1U : 0U; // invalid points have z = 0
    }
  const std::uint64_t behind = points - in_front;
  depth_measure =
      behind * 100 > points ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS;
}

std::size_t OrganizedPoints::countValid() const
{
  // Eight counters of a byte in one word, added up before one of them can overflow.
  constexpr std::size_t WORD = 8;
  constexpr std::size_t ROUND = 255 * WORD;
  std::size_t points = 0;
  std::size_t i = 0;
  while (i + WORD <= valid.size()) {
    std::uint64_t counters = 0;
    const std::size_t end = std::min(valid.size(), i + ROUND);
    for (; i + WORD <= end; i += WORD) {
      std::uint64_t word = 0;
      std::memcpy(&word, &valid[i], sizeof(word));
      counters += word;
    }
    for (; counters != 0; counters >>= 8U)
      points += counters & 255U;
  }
  for (; i < valid.size(); ++i)
    points += valid[i];
  return points;
}

} // namespace pcl_mrf_planes
