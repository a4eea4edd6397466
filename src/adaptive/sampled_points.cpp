// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/sampled_points.h"
#include "adaptive/lanes.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace pcl_mrf_planes::adaptive {

namespace {

/// A plane in the precision of the points, and what a metre from it costs.
struct NearPlane {
  float a, b, c, d;
  float per_metre; ///< sigmas

  Floats cost(const Floats& x, const Floats& y, const Floats& z) const
  {
    const Floats distance = a * x + b * y + c * z + d;
    return (distance < 0.0f ? -distance : distance) * per_metre;
  }
};

/// Samples of a row or a column of so many points.
int samplesOf(int length, int every)
{
  return (length + every - 1) / every;
}

/// Calls work(every); the compiler knows the usual ones.
template <typename Work>
void withStep(int every, const Work& work)
{
  if (every == 2)
    work(std::integral_constant<int, 2>());
  else if (every == 3)
    work(std::integral_constant<int, 3>());
  else
    work(every);
}

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
                 const FrameVector<FittedPlane>& planes, const NoiseLaw& noise,
                 const AdaptiveParameters& parameters, std::vector<std::uint16_t>& out)
  : out_(out)
  , points_(points)
  , samples_(samples)
  , labels_(labels)
  , every_(every)
  , none_(static_cast<float>(parameters.none_cost))
  {
    for (const FittedPlane& plane : planes)
      planes_.push_back(nearPlane(plane, noise, parameters));
  }

  /// \param wide working memory
  void spreadRow(int row, FrameVector<std::uint16_t>& wide)
  {
    const std::uint16_t* above = rowOf(row);
    const std::uint16_t* below = rowOf(std::min(row + 1, samples_.height - 1));
    const int bottom = std::min(points_.height, (row + 1) * every_);
    widen(above, wide);
    for (int v = row * every_; v < bottom; ++v)
      copyRow(v, wide);
    const int last = samples_.width - 1;
    for (int c = 0; (c = findMixed(above, below, c, last)) <= last; ++c) {
      const int next = std::min(c + 1, last);
      decide(Around(above[c], above[next], below[c], below[next]), c * every_,
             row * every_, bottom);
    }
  }

private:
  /// The different labels at the corners of a square.
  struct Around {
    Around(std::uint16_t first, std::uint16_t second, std::uint16_t third,
           std::uint16_t fourth)
    : labels{first}
    {
      for (const std::uint16_t label : {second, third, fourth})
        if (std::find(labels, labels + count, label) == labels + count)
          labels[count++] = label;
    }

    std::uint16_t labels[4];
    int count = 1;
  };

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
  void widen(const std::uint16_t* samples, FrameVector<std::uint16_t>& wide) const
  {
    wide.resize(static_cast<std::size_t>(samples_.width) *
                static_cast<std::size_t>(every_));
    withStep(every_, [&](auto step) { widenBy(step, samples, wide.data()); });
  }

  template <typename Step>
  void widenBy(Step step, const std::uint16_t* samples, std::uint16_t* to) const
  {
    for (int c = 0; c < samples_.width; ++c, to += step)
      for (int k = 0; k < step; ++k)
        to[k] = samples[c];
  }

  /// The label of the sample to the left and above for all valid points of a row.
  void copyRow(int v, const FrameVector<std::uint16_t>& wide)
  {
    const std::uint16_t* from = wide.data();
    std::uint16_t* to = &out_[at(0, v)];
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
      for (int u = left; u < right; u += LANES)
        decideRow(around, at(u, v), std::min(LANES, right - u));
  }

  /// So many neighbours at once, LANES at most.
  void decideRow(const Around& around, std::size_t i, int count)
  {
    const Floats x = load(points_.x, i);
    const Floats y = load(points_.y, i);
    const Floats z = load(points_.z, i);
    const auto cost = [&](std::uint16_t label) {
      return label == 0 ? none_ + Floats{} : planes_[label - 1U].cost(x, y, z);
    };
    Words best = around.labels[0] + Words{};
    Floats least = cost(around.labels[0]);
    for (int k = 1; k < around.count; ++k) {
      const Floats other = cost(around.labels[k]);
      best = other < least ? around.labels[k] + Words{} : best;
      least = other < least ? other : least;
    }
    for (int k = 0; k < count; ++k) {
      const std::size_t point = i + static_cast<std::size_t>(k);
      out_[point] = static_cast<std::uint16_t>(best[k] * points_.valid[point]);
    }
  }

  /// Four numbers from the i-th on, or as many as there are.
  static Floats load(const std::vector<float>& from, std::size_t i)
  {
    if (i + LANES <= from.size())
      return loadFour(&from[i]);
    Floats last = {};
    std::memcpy(&last, &from[i], (from.size() - i) * sizeof(float));
    return last;
  }

  std::vector<std::uint16_t>& out_;
  const OrganizedPoints& points_;
  const OrganizedPoints& samples_;
  const std::vector<std::uint16_t>& labels_;
  int every_;
  float none_;
  FrameVector<NearPlane> planes_;
};

} // namespace

int samplingStep(const OrganizedPoints& points, const AdaptiveParameters& parameters)
{
  const auto samples = [&](int every) {
    return static_cast<std::size_t>(samplesOf(points.width, every)) *
           static_cast<std::size_t>(samplesOf(points.height, every));
  };
  int every = parameters.sampling;
  while (every > 1 &&
         samples(every) < static_cast<std::size_t>(parameters.least_samples))
    --every;
  return every;
}

OrganizedPoints samplePoints(const OrganizedPoints& points, int every,
                             unsigned int threads)
{
  OrganizedPoints samples;
  samplePoints(points, every, threads, samples);
  return samples;
}

void samplePoints(const OrganizedPoints& points, int every, unsigned int threads,
                  OrganizedPoints& samples)
{
  samples.setSize(samplesOf(points.width, every), samplesOf(points.height, every));
  samples.depth_measure = points.depth_measure;
  const auto step = static_cast<std::size_t>(every);
  const auto columns = static_cast<std::size_t>(samples.width);
  const auto take = [&](const auto& from, std::size_t r, auto& to) {
    const auto* row = &from[r * step * static_cast<std::size_t>(points.width)];
    auto* out = &to[r * columns];
    withStep(every, [&](auto known) {
      for (std::size_t c = 0; c < columns; ++c)
        out[c] = row[static_cast<std::size_t>(known) * c];
    });
  };
  parallelRows(samples.height, threads, [&](int row) {
    const auto r = static_cast<std::size_t>(row);
    take(points.x, r, samples.x);
    take(points.y, r, samples.y);
    take(points.z, r, samples.z);
    take(points.valid, r, samples.valid);
  });
}

std::vector<std::uint16_t>
spreadLabels(const OrganizedPoints& points, const OrganizedPoints& samples,
             const std::vector<std::uint16_t>& labels, int every,
             const FrameVector<FittedPlane>& planes, const NoiseLaw& noise,
             const AdaptiveParameters& parameters, unsigned int threads)
{
  std::vector<std::uint16_t> out;
  spreadLabels(points, samples, labels, every, planes, noise, parameters, threads, out);
  return out;
}

void spreadLabels(const OrganizedPoints& points, const OrganizedPoints& samples,
                  const std::vector<std::uint16_t>& labels, int every,
                  const FrameVector<FittedPlane>& planes, const NoiseLaw& noise,
                  const AdaptiveParameters& parameters, unsigned int threads,
                  std::vector<std::uint16_t>& out)
{
  out.resize(points.size());
  LabelSpreading spreading(points, samples, labels, every, planes, noise, parameters,
                           out);
  const Bands bands(samples.height);
  parallelParts(bands.count, threads, [&](int band) {
    FrameVector<std::uint16_t> wide;
    for (int row = bands.begin(band); row < bands.begin(band + 1); ++row)
      spreading.spreadRow(row, wide);
  });
}

} // namespace pcl_mrf_planes::adaptive
