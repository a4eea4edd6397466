// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/sampled_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl_mrf_planes::adaptive {

namespace {

/// A plane in the precision of the points, and what a metre from it costs.
struct NearPlane {
  float a, b, c, d;
  float per_metre; ///< sigmas

  float cost(float x, float y, float z) const
  {
    return std::abs(a * x + b * y + c * z + d) * per_metre;
  }
};

NearPlane nearPlane(const FittedPlane& plane, const NoiseLaw& noise,
                    const AdaptiveParameters& parameters)
{
  const double sigma = std::sqrt(allowedVariance(plane, noise, parameters));
  return {static_cast<float>(plane.normal.x()), static_cast<float>(plane.normal.y()),
          static_cast<float>(plane.normal.z()), static_cast<float>(plane.d),
          static_cast<float>(1.0 / sigma)};
}

/// Spreads the labels of a row of samples over the rows of points down to the next.
class LabelSpreading {
public:
  LabelSpreading(const OrganizedPoints& points, const OrganizedPoints& samples,
                 const std::vector<std::uint16_t>& labels, int every,
                 const std::vector<FittedPlane>& planes, const NoiseLaw& noise,
                 const AdaptiveParameters& parameters)
  : out(points.size())
  , points_(points)
  , samples_(samples)
  , labels_(labels)
  , every_(every)
  , none_(static_cast<float>(parameters.none_cost))
  , wide_(static_cast<std::size_t>(samples.width * every))
  {
    for (const FittedPlane& plane : planes)
      planes_.push_back(nearPlane(plane, noise, parameters));
  }

  void spreadRow(int row)
  {
    const std::uint16_t* above = rowOf(row);
    const std::uint16_t* below = rowOf(std::min(row + 1, samples_.height - 1));
    const int bottom = std::min(points_.height, (row + 1) * every_);
    widen(above);
    for (int v = row * every_; v < bottom; ++v)
      copyRow(v);
    const int last = samples_.width - 1;
    for (int c = 0; (c = findMixed(above, below, c, last)) <= last; ++c) {
      const int next = std::min(c + 1, last);
      decide({above[c], above[next], below[c], below[next]}, c * every_, row * every_,
             bottom);
    }
  }

  std::vector<std::uint16_t> out;

private:
  using Around = std::array<std::uint16_t, 4>;

  const std::uint16_t* rowOf(int row) const
  {
    return &labels_[static_cast<std::size_t>(row) *
                    static_cast<std::size_t>(samples_.width)];
  }

  std::size_t at(int u, int v) const
  {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(points_.width) +
           static_cast<std::size_t>(u);
  }

  /// The labels of a row of samples, each as often as it stands for points.
  void widen(const std::uint16_t* samples)
  {
    std::uint16_t* to = wide_.data();
    if (every_ == 2) { // the usual case
      for (int c = 0; c < samples_.width; ++c)
        to[2 * c] = to[2 * c + 1] = samples[c];
      return;
    }
    for (int c = 0; c < samples_.width; ++c, to += every_)
      std::fill_n(to, every_, samples[c]);
  }

  /// The label of the sample to the left and above for all valid points of a row.
  void copyRow(int v)
  {
    const std::uint16_t* from = wide_.data();
    std::uint16_t* to = &out[at(0, v)];
    const std::uint8_t* valid = &points_.valid[at(0, v)];
    for (int u = 0; u < points_.width; ++u)
      to[u] = static_cast<std::uint16_t>(from[u] * valid[u]);
  }

  /// The first square from column c on whose corners carry different labels, or one past
  /// the last. Four squares are looked at at once.
  static int findMixed(const std::uint16_t* above, const std::uint16_t* below, int c,
                       int last)
  {
    constexpr int AT_ONCE = 4;
    const auto four = [](const std::uint16_t* labels) {
      std::uint64_t word = 0;
      std::memcpy(&word, labels, sizeof(word));
      return word;
    };
    for (; c + AT_ONCE <= last; c += AT_ONCE) {
      const std::uint64_t own = four(above + c);
      if (((own ^ four(above + c + 1)) | (own ^ four(below + c)) |
           (own ^ four(below + c + 1))) != 0)
        break;
    }
    for (; c <= last; ++c) {
      const int next = std::min(c + 1, last);
      if (above[c] != above[next] || above[c] != below[c] || above[c] != below[next])
        break;
    }
    return c;
  }

  /// The points of a square whose corners carry different labels.
  void decide(const Around& around, int left, int top, int bottom)
  {
    const int right = std::min(points_.width, left + every_);
    for (int v = top; v < bottom; ++v)
      for (int u = left; u < right; ++u)
        if (const std::size_t i = at(u, v); points_.valid[i] != 0)
          out[i] = best(around, i);
  }

  std::uint16_t best(const Around& around, std::size_t i) const
  {
    std::uint16_t label = around[0];
    float least = cost(label, i);
    for (std::size_t k = 1; k < around.size(); ++k)
      if (const float other = cost(around[k], i); other < least) {
        least = other;
        label = around[k];
      }
    return label;
  }

  float cost(std::uint16_t label, std::size_t i) const
  {
    return label == 0
               ? none_
               : planes_[label - 1U].cost(points_.x[i], points_.y[i], points_.z[i]);
  }

  const OrganizedPoints& points_;
  const OrganizedPoints& samples_;
  const std::vector<std::uint16_t>& labels_;
  int every_;
  float none_;
  std::vector<std::uint16_t> wide_; ///< labels of the row at hand
  std::vector<NearPlane> planes_;
};

} // namespace

OrganizedPoints samplePoints(const OrganizedPoints& points, int every)
{
  OrganizedPoints samples;
  samples.resize((points.width + every - 1) / every,
                 (points.height + every - 1) / every);
  samples.depth_measure = points.depth_measure;
  const auto step = static_cast<std::size_t>(every);
  const auto columns = static_cast<std::size_t>(samples.width);
  const auto take = [&](const auto& from, auto& to) {
    for (std::size_t r = 0; r < static_cast<std::size_t>(samples.height); ++r) {
      const auto* row = &from[r * step * static_cast<std::size_t>(points.width)];
      auto* out = &to[r * columns];
      if (step == 2) // the usual case
        for (std::size_t c = 0; c < columns; ++c)
          out[c] = row[2 * c];
      else
        for (std::size_t c = 0; c < columns; ++c)
          out[c] = row[step * c];
    }
  };
  take(points.x, samples.x);
  take(points.y, samples.y);
  take(points.z, samples.z);
  take(points.valid, samples.valid);
  return samples;
}

std::vector<std::uint16_t>
spreadLabels(const OrganizedPoints& points, const OrganizedPoints& samples,
             const std::vector<std::uint16_t>& labels, int every,
             const std::vector<FittedPlane>& planes, const NoiseLaw& noise,
             const AdaptiveParameters& parameters)
{
  LabelSpreading spreading(points, samples, labels, every, planes, noise, parameters);
  for (int row = 0; row < samples.height; ++row)
    spreading.spreadRow(row);
  return std::move(spreading.out);
}

} // namespace pcl_mrf_planes::adaptive
