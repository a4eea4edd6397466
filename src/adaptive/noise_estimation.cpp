// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/noise_estimation.h"
#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

struct Sample {
  double z, rms;
};

double percentile(std::vector<double> v, double p)
{
  if (v.empty())
    return 0;
  const auto k = static_cast<std::ptrdiff_t>(p * static_cast<double>(v.size() - 1));
  std::nth_element(v.begin(), v.begin() + k, v.end());
  return v[static_cast<std::size_t>(k)];
}

/// RMS with the three fitted parameters taken out, as if seen from the front
double unbiasedRms(const FittedPlane& p)
{
  return std::sqrt(p.mse * p.n / (p.n - 3) / incidenceFactor(p));
}

/// rms = a + c z^2 over depth bins, relative least squares, a and c not negative
void fitDepthLaw(std::vector<Sample> samples, double p, NoiseLaw& noise)
{
  if (samples.empty())
    return;
  std::sort(samples.begin(), samples.end(), [](const Sample& s, const Sample& t) {
    return s.z < t.z || (s.z == t.z && s.rms < t.rms);
  });
  const std::size_t bins = std::min<std::size_t>(8, 1 + samples.size() / 40);
  double s00 = 0, s01 = 0, s11 = 0, b0 = 0, b1 = 0;
  for (std::size_t k = 0; k < bins; ++k) {
    const std::size_t i0 = k * samples.size() / bins;
    const std::size_t i1 = (k + 1) * samples.size() / bins;
    std::vector<double> rms;
    for (std::size_t i = i0; i < i1; ++i)
      rms.push_back(samples[i].rms);
    const double z = samples[(i0 + i1) / 2].z;
    const double r = std::max(percentile(rms, p), 1e-7);
    const double u = 1 / r, v = z * z / r;
    s00 += u * u;
    s01 += u * v;
    s11 += v * v;
    b0 += u;
    b1 += v;
  }
  const double det = s00 * s11 - s01 * s01;
  double a = det > 1e-9 * s00 * s11 ? (b0 * s11 - b1 * s01) / det : -1;
  double c = det > 1e-9 * s00 * s11 ? (s00 * b1 - s01 * b0) / det : -1;
  if (a < 0 || c < 0) {
    const double only_a = b0 / s00, only_c = b1 / s11;
    // the one that explains more: error = bins - b^2 / s
    const bool keep_c = b1 * b1 / s11 >= b0 * b0 / s00;
    a = keep_c ? 0 : only_a;
    c = keep_c ? only_c : 0;
  }
  noise.a = a;
  noise.c = c;
}

} // namespace

double NoiseLaw::growthOf(double n) const
{
  const double l = std::max(0.0, 0.5 * std::log2(std::max(n, 1.0)) - std::log2(cell));
  const auto i = static_cast<std::size_t>(l);
  const std::size_t last = growth.size() - 1;
  const double t = l - static_cast<double>(i);
  double g = region;
  if (i < last)
    g = growth[i] + t * (growth[i + 1] - growth[i]);
  else if (l < static_cast<double>(last + 2)) // region's value at 4 largest tiles' side
    g = growth[last] + (l - static_cast<double>(last)) / 2 * (region - growth[last]);
  return g;
}

NoiseLaw estimateNoise(const std::vector<TileLevel>& pyramid,
                       const AdaptiveParameters& parameters)
{
  NoiseLaw noise;
  noise.floor = parameters.min_sigma;
  noise.cell = parameters.cell;
  const std::size_t base = pyramid.size() > 1 ? 1 : 0;
  std::vector<Sample> samples;
  for (const FittedPlane& p : pyramid[base].planes)
    if (p.n > 3)
      samples.push_back({p.centroid.norm(), unbiasedRms(p)});
  fitDepthLaw(std::move(samples), parameters.noise_percentile, noise);

  // growth from level to level, among parents whose children are all good
  std::vector<double> step(pyramid.size(), 1.0);
  double cumulated = 1;
  for (std::size_t l = 1; l < pyramid.size(); ++l) {
    const TileLevel& level = pyramid[l];
    const TileLevel& below = pyramid[l - 1];
    std::vector<double> ratios;
    for (int r = 0; r < level.rows; ++r)
      for (int c = 0; c < level.columns; ++c) {
        const FittedPlane& parent = level.planes[level.at(c, r)];
        if (parent.n < 4 || 2 * r + 1 >= below.rows || 2 * c + 1 >= below.columns)
          continue;
        double mean = 0;
        bool good = true;
        for (int k = 0; k < 4 && good; ++k) {
          const FittedPlane& child =
              below.planes[below.at(2 * c + k % 2, 2 * r + k / 2)];
          good = child.n > 3 &&
                 unbiasedRms(child) <
                     2 * cumulated * noise.small(child.centroid.norm()) + 1e-12;
          mean += good ? unbiasedRms(child) * unbiasedRms(child) / 4 : 0;
        }
        if (good)
          ratios.push_back(
              unbiasedRms(parent) /
              std::max(std::sqrt(mean), noise.small(parent.centroid.norm()) / 4));
      }
    if (ratios.size() >= 12)
      step[l] = std::clamp(percentile(ratios, parameters.growth_percentile), 1.0,
                           parameters.max_growth);
    if (l > base)
      cumulated *= step[l];
  }
  noise.growth.assign(pyramid.size(), 1.0);
  for (std::size_t l = base + 1; l < pyramid.size(); ++l)
    noise.growth[l] = noise.growth[l - 1] * step[l];
  for (std::size_t l = base; l-- > 0;)
    noise.growth[l] = noise.growth[l + 1] / step[l + 1];
  noise.region = noise.growth.back();
  // correlated noise keeps growing beyond the largest tile; white noise does not
  const double correlated = std::clamp((noise.growth.back() - 1.05) / 0.25, 0.0, 1.0);
  noise.region *= 1 + correlated * (parameters.long_range - 1);
  return noise;
}

void assignLocalNoise(std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                      const AdaptiveParameters& parameters)
{
  const std::size_t base = pyramid.size() > 1 ? 1 : 0;
  const TileLevel& level = pyramid[base];
  std::vector<double> factor(level.sums.size(), 1.0), around;
  const int reach = parameters.local_reach;
  for (int r = 0; r < level.rows; ++r)
    for (int c = 0; c < level.columns; ++c) {
      if (level.sums[level.at(c, r)].n < 1)
        continue;
      around.clear();
      for (int j = std::max(0, r - reach); j <= std::min(level.rows - 1, r + reach);
           ++j)
        for (int i = std::max(0, c - reach);
             i <= std::min(level.columns - 1, c + reach); ++i) {
          const FittedPlane& p = level.planes[level.at(i, j)];
          if (p.n > 3)
            around.push_back(unbiasedRms(p) / noise.small(p.centroid.norm()));
        }
      if (around.size() >= 4)
        factor[level.at(c, r)] = std::clamp(
            percentile(around, parameters.local_percentile), 1.0, parameters.max_local);
    }
  TileLevel& cells = pyramid[0];
  for (int r = 0; r < cells.rows; ++r)
    for (int c = 0; c < cells.columns; ++c) {
      TileSums& s = cells.sums[cells.at(c, r)];
      if (s.n < 1)
        continue;
      const double range = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z) / s.n;
      const double sigma = noise.small(range) * factor[level.at(c >> base, r >> base)];
      s.noise = s.n * sigma * sigma;
    }
  for (std::size_t l = 0; l < pyramid.size(); ++l)
    for (int r = 0; r < pyramid[l].rows; ++r)
      for (int c = 0; c < pyramid[l].columns; ++c) {
        const std::size_t i = pyramid[l].at(c, r);
        if (pyramid[l].sums[i].n < 1)
          continue;
        if (l > 0) {
          const TileLevel& below = pyramid[l - 1];
          pyramid[l].sums[i].noise = 0;
          for (int j = 2 * r; j < std::min(2 * r + 2, below.rows); ++j)
            for (int k = 2 * c; k < std::min(2 * c + 2, below.columns); ++k)
              pyramid[l].sums[i].noise += below.sums[below.at(k, j)].noise;
        }
        pyramid[l].planes[i].noise = pyramid[l].sums[i].noise / pyramid[l].sums[i].n;
      }
}

} // namespace pcl_mrf_planes::adaptive
