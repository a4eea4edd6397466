// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/organized_points.h>

#include "organized_points_kernel.h"
#include "threads.h"

#include <algorithm>
#include <array>
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

void OrganizedPoints::resolveDepthMeasure(DepthMeasure wanted, unsigned int threads)
{
  depth_measure = wanted;
  if (wanted != DepthMeasure::AUTO)
    return;
  // Some rows tell it: a laser scanner that sees behind itself does so in all of them.
  constexpr int STEP = 4;
  constexpr int FEW = 8; // bands, for which no memory is asked
  const auto columns = static_cast<std::size_t>(width);
  const Bands bands((height + STEP - 1) / STEP, FEW);
  struct Sides {
    std::uint32_t points = 0; // fewer than 2^31
    std::uint32_t in_front = 0;
  };
  std::array<Sides, FEW> seen = {};
  parallelParts(bands.count, threads, [&](int band) {
    Sides here; // next to those of other threads it would be slow
    for (int row = STEP * bands.begin(band);
         row < std::min(STEP * bands.begin(band + 1), height); row += STEP) {
      const std::size_t begin = static_cast<std::size_t>(row) * columns;
      for (std::size_t i = begin; i < begin + columns; ++i) {
        here.points += valid[i];
        here.in_front += z[i] > 0.0f ? 1U : 0U; // invalid points have z = 0
      }
    }
    seen[static_cast<std::size_t>(band)] = here;
  });
  std::uint64_t points = 0;
  std::uint64_t behind = 0;
  for (const Sides& here : seen) {
    points += here.points;
    behind += here.points - here.in_front;
  }
  depth_measure =
      behind * 100 > points ? DepthMeasure::RANGE : DepthMeasure::OPTICAL_AXIS;
}

namespace {

/// How many of the bytes from \a valid to \a last are 1; the others are 0.
std::size_t countOnes(const std::uint8_t* valid, const std::uint8_t* last)
{
  // Eight counters of a byte in one word, added up before one of them can overflow.
  constexpr std::size_t WORD = 8;
  constexpr std::size_t ROUND = 255 * WORD;
  const auto size = static_cast<std::size_t>(last - valid);
  std::size_t points = 0;
  std::size_t i = 0;
  while (i + WORD <= size) {
    std::uint64_t counters = 0;
    const std::size_t end = std::min(size, i + ROUND);
    for (; i + WORD <= end; i += WORD) {
      std::uint64_t word = 0;
      std::memcpy(&word, valid + i, sizeof(word));
      counters += word;
    }
    for (; counters != 0; counters >>= 8U)
      points += counters & 255U;
  }
  for (; i < size; ++i)
    points += valid[i];
  return points;
}

} // namespace

std::size_t OrganizedPoints::countValid(unsigned int threads) const
{
  const auto columns = static_cast<std::size_t>(width);
  return sumOfBands(
      height, threads, std::size_t{0}, [&](int first, int last, std::size_t& points) {
        points = countOnes(valid.data() + static_cast<std::size_t>(first) * columns,
                           valid.data() + static_cast<std::size_t>(last) * columns);
      });
}

} // namespace pcl_mrf_planes
