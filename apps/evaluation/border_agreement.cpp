// SPDX-License-Identifier: BSD-3-Clause
#include "border_agreement.h"

#include "contingency_table.h"

#include <stdexcept>
#include <vector>

namespace pcl_mrf_planes::evaluation {

namespace {

/// A flag for each point.
using Mask = std::vector<char>;

/// Calls visit(i, j) for all neighbours in a row or a column.
template <typename Visit>
void forEachPair(int width, int height, const Visit& visit)
{
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  for (std::size_t y = 0; y < h; ++y)
    for (std::size_t x = 0; x < w; ++x) {
      const std::size_t i = y * w + x;
      if (x + 1 < w)
        visit(i, i + 1);
      if (y + 1 < h)
        visit(i, i + w);
    }
}

Mask borders(const LabelImage& image, const LabelImage& truth)
{
  Mask border(image.size(), 0);
  forEachPair(image.width, image.height, [&](std::size_t i, std::size_t j) {
    if (image.labels[i] != image.labels[j] && truth.labels[i] != NOT_SCORED &&
        truth.labels[j] != NOT_SCORED)
      border[i] = border[j] = 1;
  });
  return border;
}

/// Sets the flags of a line that are at most so far from one that was set.
void widenLine(const char* in, char* out, int count, std::ptrdiff_t step, int distance)
{
  int last = -1; // the last flag seen, from the left and then from the right
  for (int k = 0; k < count; ++k) {
    if (in[k * step] != 0)
      last = k;
    out[k * step] = last >= 0 && k - last <= distance ? 1 : 0;
  }
  last = -1;
  for (int k = count - 1; k >= 0; --k) {
    if (in[k * step] != 0)
      last = k;
    if (last >= 0 && last - k <= distance)
      out[k * step] = 1;
  }
}

/// The flags at most so many columns and rows from one that is set.
Mask widen(const Mask& mask, int width, int height, int distance)
{
  Mask rows(mask.size()), both(mask.size());
  for (int y = 0; y < height; ++y) {
    const std::ptrdiff_t start = static_cast<std::ptrdiff_t>(y) * width;
    widenLine(mask.data() + start, rows.data() + start, width, 1, distance);
  }
  for (int x = 0; x < width; ++x)
    widenLine(rows.data() + x, both.data() + x, height, width, distance);
  return both;
}

void count(const Mask& border, const Mask& near, std::int64_t& points,
           std::int64_t& found)
{
  for (std::size_t i = 0; i < border.size(); ++i) {
    points += border[i];
    found += border[i] & near[i];
  }
}

} // namespace

double BorderAgreement::f() const
{
  if (truth_points == 0)
    return NONE;
  if (truth_found == 0 || label_found == 0)
    return 0.0;
  return 2.0 * precision() * recall() / (precision() + recall());
}

BorderAgreement compareBorders(const LabelImage& truth, const LabelImage& labels,
                               int distance)
{
  checkComparable(truth, labels);
  if (distance < 0)
    throw std::invalid_argument("the distance of borders must not be negative");
  const Mask of_truth = borders(truth, truth);
  const Mask of_labels = borders(labels, truth);
  BorderAgreement result;
  result.distance = distance;
  count(of_truth, widen(of_labels, truth.width, truth.height, distance),
        result.truth_points, result.truth_found);
  count(of_labels, widen(of_truth, truth.width, truth.height, distance),
        result.label_points, result.label_found);
  return result;
}

} // namespace pcl_mrf_planes::evaluation
