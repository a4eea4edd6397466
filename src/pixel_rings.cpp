// SPDX-License-Identifier: BSD-3-Clause
#include "pixel_rings.h"

#include <algorithm>
#include <cstddef>
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
  RingTracer(const LabelRuns& image, const RunParts& parts)
  : image_(image)
  , parts_(parts)
  , width_(static_cast<int>(image.width))
  , stride_(width_ + 2)
  , part_(image.rows.empty() ? 0 : (image.rows.size() + 1) * (image.width + 2), NONE)
  , seen_(part_.size(), 0)
  {
    for (int d = 0; d < DIRECTIONS; ++d) {
      step_[d] = DY[d] * stride_ + DX[d];
      beside_[d] = PY[d] * stride_ + PX[d];
    }
    for (std::size_t row = 0; row + 1 < image.rows.size(); ++row)
      for (std::size_t k = image.rows[row]; k < image.rows[row + 1]; ++k)
        std::fill_n(part_.begin() + place(image.runs[k].begin, row),
                    image.runs[k].end - image.runs[k].begin, parts.part_of_run[k]);
  }

  std::vector<PixelRings> trace()
  {
    std::vector<PixelRings> rings(parts_.size.size());
    // Every ring has an upper edge of a pixel; that of the outer one comes first.
    for (std::size_t row = 0; row + 1 < image_.rows.size(); ++row)
      for (std::size_t k = image_.rows[row]; k < image_.rows[row + 1]; ++k) {
        const LabelRun& run = image_.runs[k];
        const int part = parts_.part_of_run[k];
        const int begin = static_cast<int>(place(run.begin, row));
        const int end = begin + static_cast<int>(run.end - run.begin);
        for (int at = skipCovered(begin, end, part); at < end;
             at = skipCovered(at + 1, end, part))
          if (!isSeen(at))
            rings[static_cast<std::size_t>(part)].push_back(follow(
                at, at - begin + static_cast<int>(run.begin - row * image_.width),
                static_cast<int>(row), part));
      }
    return rings;
  }

private:
  static constexpr int NONE = -1;

  /// Of a point in part_, which has a pixel of no part around the image.
  std::ptrdiff_t place(std::size_t point, std::size_t row) const
  {
    return static_cast<std::ptrdiff_t>(point + 2 * row + 1 + image_.width + 2);
  }
  /// Not past the first place that has another part above it.
  int skipCovered(int at, int end, int part) const
  {
    constexpr int AT_ONCE = 8;
    for (; at + AT_ONCE <= end; at += AT_ONCE) {
      const int* above = &part_[static_cast<std::size_t>(at - stride_)];
      int differ = 0;
      for (int k = 0; k < AT_ONCE; ++k)
        differ |= above[k] ^ part;
      if (differ != 0)
        break;
    }
    while (at < end && partAt(at - stride_) == part)
      ++at;
    return at;
  }

  int partAt(int at) const { return part_[static_cast<std::size_t>(at)]; }
  bool isSeen(int at) const { return seen_[static_cast<std::size_t>(at)] != 0; }

  /// \param[in] at place of the pixel (x, y), whose upper edge the ring starts with
  std::vector<PixelCorner> follow(int at, int x, int y, int part)
  {
    std::vector<PixelCorner> ring;
    ring.reserve(64);
    int direction = 0;
    bool touched = isTouched(at, part);
    const int start = at;
    do {
      ring.push_back({x, y, (y + PY[direction]) * width_ + x + PX[direction], touched});
      if (direction == 0)
        seen_[static_cast<std::size_t>(at)] = 1;
      at += step_[direction];
      x += DX[direction];
      y += DY[direction];
      const int left = (direction + DIRECTIONS - 1) % DIRECTIONS;
      const bool ahead_left = partAt(at + beside_[left]) == part;
      const bool ahead_right = partAt(at + beside_[direction]) == part;
      touched = ahead_left && !ahead_right;
      if (ahead_left)
        direction = left;
      else if (!ahead_right)
        direction = (direction + 1) % DIRECTIONS;
    } while (at != start || direction != 0);
    return ring;
  }

  /// Whether pixels of the part meet at the upper left corner of a pixel only.
  bool isTouched(int at, int part) const
  {
    const bool down_right = partAt(at) == part;
    const bool down_left = partAt(at - 1) == part;
    const bool up_left = partAt(at - 1 - stride_) == part;
    const bool up_right = partAt(at - stride_) == part;
    return down_right == up_left && down_left == up_right && down_right != down_left;
  }

  const LabelRuns& image_;
  const RunParts& parts_;
  int width_;
  int stride_;
  int step_[DIRECTIONS];           ///< from a place to the next
  int beside_[DIRECTIONS];         ///< from a corner's place to the pixel on the right
  std::vector<int> part_;          ///< of every pixel
  std::vector<std::uint8_t> seen_; ///< upper edges of pixels
};

} // namespace

std::vector<PixelRings> tracePixelRings(const LabelRuns& image, const RunParts& parts)
{
  return RingTracer(image, parts).trace();
}

} // namespace pcl_mrf_planes
