// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/sampled_points.h"

#include <algorithm>
#include <array>
#include <cmath>

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
  {
    for (const FittedPlane& plane : planes)
      planes_.push_back(nearPlane(plane, noise, parameters));
  }

  void spreadRow(int row)
  {
    const std::uint16_t* above = rowOf(row);
    const std::uint16_t* below = rowOf(std::min(row + 1, samples_.height - 1));
    const int bottom = std::min(points_.height, (row + 1) * every_);
    for (int v = row * every_; v < bottom; ++v)
      copyRow(above, v);
    const int last = samples_.width - 1;
    for (int c = 0; c <= last; ++c) {
      const int next = std::min(c + 1, last);
      const Around around = {above[c], above[next], below[c], below[next]};
      if (around[0] != around[1] || around[0] != around[2] || around[0] != around[3])
        decide(around, c * every_, row * every_, bottom);
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

  /// The label of the sample to the left and above for all valid points of a row.
  void copyRow(const std::uint16_t* from, int v)
  {
    std::uint16_t* to = &out[at(0, v)];
    const std::uint8_t* valid = &points_.valid[at(0, v)];
    const int pairs = every_ == 2 ? points_.width / 2 : 0;
    for (int c = 0; c < pairs; ++c) { // the usual case, a division less
      to[2 * c] = static_cast<std::uint16_t>(from[c] * valid[2 * c]);
      to[2 * c + 1] = static_cast<std::uint16_t>(from[c] * valid[2 * c + 1]);
    }
    for (int u = 2 * pairs; u < points_.width; ++u)
      to[u] = static_cast<std::uint16_t>(from[u / every_] * valid[u]);
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
    return label == 0 ? none_
                      : planes_[label - 1U].cost(points_.x[i], points_.y[i], points_.z[i]);
  }

  const OrganizedPoints& points_;
  const OrganizedPoints& samples_;
  const std::vector<std::uint16_t>& labels_;
  int every_;
  float none_;
  std::vector<NearPlane> planes_;
};

} // namespace

OrganizedPoints samplePoints(const OrganizedPoints& points, int every)
{
  OrganizedPoints samples;
  samples.resize((points.width + every - 1) / every, (points.height + every - 1) / every);
  samples.depth_measure = points.depth_measure;
  const auto step = static_cast<std::size_t>(every);
  std::size_t k = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(points.height); v += step)
    for (std::size_t u = 0; u < static_cast<std::size_t>(points.width); u += step) {
      const std::size_t i = v * static_cast<std::size_t>(points.width) + u;
      samples.x[k] = points.x[i];
      samples.y[k] = points.y[i];
      samples.z[k] = points.z[i];
      samples.valid[k] = points.valid[i];
      ++k;
    }
  return samples;
}

std::vector<std::uint16_t> spreadLabels(const OrganizedPoints& points,
                                        const OrganizedPoints& samples,
                                        const std::vector<std::uint16_t>& labels,
                                        int every,
                                        const std::vector<FittedPlane>& planes,
                                        const NoiseLaw& noise,
                                        const AdaptiveParameters& parameters)
{
  LabelSpreading spreading(points, samples, labels, every, planes, noise, parameters);
  for (int row = 0; row < samples.height; ++row)
    spreading.spreadRow(row);
  return std::move(spreading.out);
}

} // namespace pcl_mrf_planes::adaptive
