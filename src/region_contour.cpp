// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/region_contour.h>

#include <cstddef>

namespace pcl_mrf_planes {

namespace {

// The eight neighbours clockwise from the left.
constexpr int DIRECTIONS = 8;
constexpr int DX[DIRECTIONS] = {-1, -1, 0, 1, 1, 1, 0, -1};
constexpr int DY[DIRECTIONS] = {0, -1, -1, -1, 0, 1, 1, 1};

/// Gives the part that starts at \a seed its number, point by point.
void flood(const std::vector<std::uint16_t>& labels, int width, int height, int seed,
           ConnectedParts& parts, std::vector<int>& open)
{
  const int part = static_cast<int>(parts.size.size());
  const std::uint16_t label = labels[static_cast<std::size_t>(seed)];
  int size = 0;
  const auto visit = [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (labels[at] == label && parts.part_of_point[at] == ConnectedParts::NONE) {
      parts.part_of_point[at] = part;
      open.push_back(i);
      ++size;
    }
  };
  visit(seed);
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    const int x = i % width;
    const int y = i / width;
    if (x > 0)
      visit(i - 1);
    if (x + 1 < width)
      visit(i + 1);
    if (y > 0)
      visit(i - width);
    if (y + 1 < height)
      visit(i + width);
  }
  parts.size.push_back(size);
  parts.first.push_back(seed);
  parts.label.push_back(label);
}

} // namespace

ConnectedParts findConnectedParts(const std::vector<std::uint16_t>& labels, int width,
                                  int height)
{
  ConnectedParts parts;
  parts.part_of_point.assign(labels.size(), ConnectedParts::NONE);
  std::vector<int> open;
  for (int i = 0; i < width * height; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (labels[at] != 0 && parts.part_of_point[at] == ConnectedParts::NONE)
      flood(labels, width, height, i, parts, open);
  }
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
