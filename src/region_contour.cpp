// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/region_contour.h>

#include "label_runs.h"

#include <algorithm>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

// The eight neighbours clockwise from the left.
constexpr int DIRECTIONS = 8;
constexpr int DX[DIRECTIONS] = {-1, -1, 0, 1, 1, 1, 0, -1};
constexpr int DY[DIRECTIONS] = {0, -1, -1, -1, 0, 1, 1, 1};

} // namespace

ConnectedParts findConnectedParts(const std::vector<std::uint16_t>& labels, int width,
                                  int)
{
  ConnectedParts parts;
  parts.part_of_point.assign(labels.size(), ConnectedParts::NONE);
  const LabelRuns image = findRuns(labels, width, 0);
  const RunParts found = connectRuns(image);
  for (std::size_t k = 0; k < image.runs.size(); ++k)
    std::fill(
        parts.part_of_point.begin() + static_cast<std::ptrdiff_t>(image.runs[k].begin),
        parts.part_of_point.begin() + static_cast<std::ptrdiff_t>(image.runs[k].end),
        found.part_of_run[k]);
  parts.size.assign(found.size.begin(), found.size.end());
  parts.label.assign(found.label.begin(), found.label.end());
  for (const std::size_t first : found.first)
    parts.first.push_back(static_cast<int>(first));
  return parts;
}

std::vector<int> traceContour(const ConnectedParts& parts, int part, int width,
                              int height)
{
  const auto inside = [&](int x, int y) {
    return x >= 0 && x < width && y >= 0 && y < height &&
           parts.part_of_point[static_cast<std::size_t>(y) *
                                   static_cast<std::size_t>(width) +
                               static_cast<std::size_t>(x)] == part;
  };
  const int start = parts.first[static_cast<std::size_t>(part)];
  std::vector<int> contour;
  int x = start % width;
  int y = start / width;
  int first_step = -1;
  // The first point has nothing of the part above it or to its left: look from there.
  int came_from = 0;
  while (true) {
    int step = -1;
    for (int k = 1; k <= DIRECTIONS && step < 0; ++k) {
      const int direction = (came_from + k) % DIRECTIONS;
      if (inside(x + DX[direction], y + DY[direction]))
        step = direction;
    }
    const int here = y * width + x;
    if (step < 0) // a part of one point
      return {here};
    if (here == start && step == first_step) // all around
      return contour;
    if (first_step < 0)
      first_step = step;
    contour.push_back(here);
    x += DX[step];
    y += DY[step];
    came_from = (step + DIRECTIONS / 2) % DIRECTIONS;
  }
}

} // namespace pcl_mrf_planes
