// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_field.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_mrf_planes::reference {

/// Belief propagation as one writes it down first: float messages, all label pairs.
/// What the library's speed is measured against.
inline std::vector<std::uint16_t>
plainFloatLabels(const PlaneField& field, const OrganizedPoints& points, int iterations)
{
  const int width = points.width;
  const int height = points.height;
  const auto labels = field.planes().size();
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  };
  std::vector<float> data(points.size() * labels, 0.0f);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t l = 0; points.valid[i] != 0 && l < labels; ++l)
      data[i * labels + l] = static_cast<float>(field.dataTerm(i, static_cast<int>(l)));
  std::vector<float> price(labels * labels);
  for (std::size_t a = 0; a < labels; ++a)
    for (std::size_t b = 0; b < labels; ++b)
      price[a * labels + b] = static_cast<float>(
          field.smoothnessTerm(static_cast<int>(a), static_cast<int>(b), 0.0));

  const int dx[4] = {-1, 1, 0, 0};
  const int dy[4] = {0, 0, -1, 1};
  std::vector<float> received[4];
  for (auto& direction : received)
    direction.assign(data.size(), 0.0f);
  std::vector<float> h(labels);
  const auto send = [&](int x, int y, int direction) {
    const int tx = x + dx[direction];
    const int ty = y + dy[direction];
    if (tx < 0 || tx >= width || ty < 0 || ty >= height)
      return;
    const std::size_t i = at(x, y);
    const std::size_t j = at(tx, ty);
    if (points.valid[i] == 0 || points.valid[j] == 0)
      return;
    for (std::size_t l = 0; l < labels; ++l) {
      h[l] = data[i * labels + l];
      for (int d = 0; d < 4; ++d)
        if (d != direction)
          h[l] += received[d][i * labels + l];
    }
    const float step = std::abs(points.depth(i) - points.depth(j));
    float* message = &received[direction ^ 1][j * labels];
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t b = 0; b < labels; ++b) {
      float best = std::numeric_limits<float>::infinity();
      for (std::size_t a = 0; a < labels; ++a)
        best = std::min(best, h[a] + std::max(step, price[a * labels + b])); // (10)
      message[b] = best;
      least = std::min(least, best);
    }
    for (std::size_t b = 0; b < labels; ++b)
      message[b] -= least;
  };
  for (int t = 0; t < iterations; ++t)
    for (int y = 0; y < height; ++y)
      for (int x = (y + t) & 1; x < width; x += 2)
        for (int direction = 0; direction < 4; ++direction)
          send(x, y, direction);

  std::vector<std::uint16_t> result(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t l = 0; l < labels; ++l) {
      float belief = data[i * labels + l];
      for (const auto& direction : received)
        belief += direction[i * labels + l];
      if (belief < least) {
        least = belief;
        result[i] = static_cast<std::uint16_t>(l);
      }
    }
  }
  return result;
}

} // namespace pcl_mrf_planes::reference
