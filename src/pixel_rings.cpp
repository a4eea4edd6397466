// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_rings.h"

#include <cstdint>

namespace pcl_mrf_planes {

namespace {

// Right, down, left, up.
constexpr int DIRECTIONS = 4;
constexpr int DX[DIRECTIONS] = {1, 0, -1, 0};
constexpr int DY[DIRECTIONS] = {0, 1, 0, -1};
// The pixel to the right of an edge that leaves a corner in a direction; the pixel to its
// left is that of the direction before.
constexpr int PX[DIRECTIONS] = {0, -1, -1, 0};
constexpr int PY[DIRECTIONS] = {0, 0, -1, -1};

class RingTracer {
public:
  RingTracer(const ConnectedParts& parts, int width, int height)
  : parts_(parts)
  , width_(width)
  , height_(height)
  , seen_(parts.part_of_point.size(), 0)
  {}

  std::vector<PixelRings> trace()
  {
    std::vector<PixelRings> rings(parts_.size.size());
    int pixel = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x, ++pixel) {
        const int part = parts_.part_of_point[static_cast<std::size_t>(pixel)];
        // Every ring has an upper edge of a pixel; that of the outer one comes first.
        if (part >= 0 && seen_[static_cast<std::size_t>(pixel)] == 0 &&
            partAt(x, y - 1) != part)
          rings[static_cast<std::size_t>(part)].push_back(follow(x, y, part));
      }
    return rings;
  }

private:
  int partAt(int x, int y) const
  {
    if (x < 0 || x >= width_ || y < 0 || y >= height_)
      return ConnectedParts::NONE;
    const int pixel = y * width_ + x;
    return parts_.part_of_point[static_cast<std::size_t>(pixel)];
  }

  std::vector<PixelCorner> follow(int x, int y, int part)
  {
    std::vector<PixelCorner> ring;
    int direction = 0;
    bool touched = isTouched(x, y, part);
    const int start_x = x;
    const int start_y = y;
    do {
      const int pixel = (y + PY[direction]) * width_ + x + PX[direction];
      ring.push_back({x, y, pixel, touched});
      if (direction == 0)
        seen_[static_cast<std::size_t>(pixel)] = 1;
      x += DX[direction];
      y += DY[direction];
      const int left = (direction + DIRECTIONS - 1) % DIRECTIONS;
      const bool ahead_left = partAt(x + PX[left], y + PY[left]) == part;
      const bool ahead_right = partAt(x + PX[direction], y + PY[direction]) == part;
      touched = ahead_left && !ahead_right;
      if (ahead_left)
        direction = left;
      else if (!ahead_right)
        direction = (direction + 1) % DIRECTIONS;
    } while (x != start_x || y != start_y || direction != 0);
    return ring;
  }

  /// Whether pixels of the part meet at a corner only.
  bool isTouched(int x, int y, int part) const
  {
    const bool down_right = partAt(x, y) == part;
    const bool down_left = partAt(x - 1, y) == part;
    const bool up_left = partAt(x - 1, y - 1) == part;
    const bool up_right = partAt(x, y - 1) == part;
    return down_right == up_left && down_left == up_right && down_right != down_left;
  }

  const ConnectedParts& parts_;
  int width_;
  int height_;
  std::vector<std::uint8_t> seen_; ///< upper edges of pixels
};

} // namespace

std::vector<PixelRings> tracePixelRings(const ConnectedParts& parts, int width,
                                        int height)
{
  return RingTracer(parts, width, height).trace();
}

} // namespace pcl_mrf_planes
