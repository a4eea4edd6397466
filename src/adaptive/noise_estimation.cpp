// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/noise_estimation.h"
#include "adaptive/tile_rms.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

namespace pcl_mrf_planes::adaptive {

namespace {

struct Sample {
  double z = 0;
  double rms = 0;
};

/// That percentile of the tiles at one depth, as long as it can be noise: where more of them
/// lie on no surface (far away in a laser scan nearly all do), what they show is no more than
/// some times what the quietest of them show. Tiles without any spread are not asked: depth
/// that is rounded to steps hides the noise within one. A tile that a step of depth crosses
/// shows an eighth to a half of it, so these are quiet enough for each other. Orders the numbers
/// as it needs.
double typicalRms(FrameVector<double>& rms, double p, double z)
{
  constexpr std::size_t FEWEST = 60; // tiles for a low percentile
  constexpr double QUIETEST = 0.2;   // of the percentile
  constexpr double MOST = 2.2;       // seen on surfaces: 1.2 to 2
  constexpr double ROUNDING = 1e-6;  // of the coordinates, relative
  const double typical = percentile(rms, p);
  rms.erase(std::remove_if(rms.begin(), rms.end(),
                           [&](double r) { return r < ROUNDING * z; }),
            rms.end());
  if (rms.size() < FEWEST)
    return typical;
  const double quiet = percentile(rms, QUIETEST * p);
  return std::min(typical, MOST * quiet);
}

/// Samples in bins of as many each, the nearest first. Within a bin they are in no order but
/// for the one in the middle: that is all that is asked for, and halves can be told apart at
/// once.
class DepthBins {
public:
  DepthBins(FrameVector<Sample> samples, std::size_t bins, unsigned int threads)
  : samples_(std::move(samples))
  , bins_(bins)
  {
    const std::size_t half = bins / 2;
    partAt(0, begin(half), samples_.size());
    parallelParts(2, threads, [&](int part) {
      if (part == 0)
        split(0, half);
      else
        split(half, bins_);
    });
  }

  /// Typical depth and rms distance of a bin. \param[in] p percentile
  Sample typical(std::size_t bin, double p) const
  {
    FrameVector<double> rms;
    rms.reserve(begin(bin + 1) - begin(bin));
    for (std::size_t i = begin(bin); i < begin(bin + 1); ++i)
      rms.push_back(samples_[i].rms);
    const double z = samples_[middle(bin)].z;
    return {z, std::max(typicalRms(rms, p, z), 1e-7)};
  }

private:
  std::size_t begin(std::size_t bin) const { return bin * samples_.size() / bins_; }
  std::size_t middle(std::size_t bin) const
  {
    return (begin(bin) + begin(bin + 1)) / 2;
  }

  /// Brings bins \a first to \a last - 1 apart, which have all samples between their ends.
  void split(std::size_t first, std::size_t last)
  {
    if (last - first > 1) {
      const std::size_t half = (first + last) / 2;
      partAt(begin(first), begin(half), begin(last));
      split(first, half);
      split(half, last);
    }
    else if (last > first)
      partAt(begin(first), middle(first), begin(last));
  }

  /// What lies before \a i is no farther then, what lies behind it no nearer.
  void partAt(std::size_t first, std::size_t i, std::size_t last)
  {
    const auto at = [&](std::size_t k) {
      return samples_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    if (i < last)
      std::nth_element(at(first), at(i), at(last),
                       [](const Sample& s, const Sample& t) {
                         return s.z < t.z || (s.z == t.z && s.rms < t.rms);
                       });
  }

  FrameVector<Sample> samples_;
  std::size_t bins_;
};

/// rms = a + c z^2 over depth bins, relative least squares, a and c not negative
void fitDepthLaw(FrameVector<Sample> samples, double p, unsigned int threads,
                 NoiseLaw& noise)
{
  if (samples.empty())
    return;
  const std::size_t count = std::min<std::size_t>(8, 1 + samples.size() / 40);
  const DepthBins bins(std::move(samples), count, threads);
  FrameVector<Sample> typical(count);
  parallelParts(static_cast<int>(count), threads, [&](int bin) {
    const auto k = static_cast<std::size_t>(bin);
    typical[k] = bins.typical(k, p);
  });
  double s00 = 0, s01 = 0, s11 = 0, b0 = 0, b1 = 0;
  for (const auto& [z, r] : typical) {
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

namespace {

/// The binary logarithm to within 0.01, of a normal number: growth is interpolated by it.
double roughLog2(double number)
{
  constexpr int MANTISSA = 52; // bits
  constexpr std::int64_t BIAS = 1023;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  const auto exponent = static_cast<std::int64_t>(bits >> MANTISSA) - BIAS;
  bits = (bits & ((std::uint64_t{1} << MANTISSA) - 1)) |
         (static_cast<std::uint64_t>(BIAS) << MANTISSA);
  double mantissa = 0; // 1 to 2
  std::memcpy(&mantissa, &bits, sizeof(mantissa));
  const double part = mantissa - 1;
  return static_cast<double>(exponent) + part * (1.3465 - 0.3465 * part);
}

} // namespace

double NoiseLaw::growthOf(double n) const
{
  constexpr double LOG2_CELL = 2;
  static_assert(CELL == 4, "growth starts with the smallest tiles");
  const double l = std::max(0.0, 0.5 * roughLog2(std::max(n, 1.0)) - LOG2_CELL);
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

namespace {

/// The planes of the four tiles that a tile is made of.
using Quarters = std::array<const FittedPlane*, 4>;

/// Mean variance of tiles that are all within the noise as far as it is known; -1: one is
/// not.
double meanVariance(const Quarters& planes, double known_growth, const NoiseLaw& noise)
{
  double sum = 0;
  for (const FittedPlane* plane : planes) {
    if (plane->n <= 3)
      return -1;
    const double variance = unbiasedVariance(*plane);
    const double limit = 2 * known_growth * noise.small(plane->centroid.norm()) + 1e-12;
    if (!(variance < limit * limit))
      return -1;
    sum += variance;
  }
  return sum / static_cast<double>(planes.size());
}

/// A row of tiles, of which every so many-th counts.
struct TileRow {
  int number, step;
};

/// One ratio for each tile of a row whose quarters are all within the noise: the rms distance
/// of the tile over that of its quarters.
class GrowthRatios {
public:
  /// \param[in] below the level of the quarters; the smallest tiles have no planes yet
  GrowthRatios(const TileLevel& level, const TileLevel& below, double known_growth,
               const NoiseLaw& noise, const AdaptiveParameters& parameters)
  : level_(level)
  , below_(below)
  , known_growth_(known_growth)
  , noise_(noise)
  , parameters_(parameters)
  {}

  void addRow(TileRow row, FrameVector<double>& ratios)
  {
    findWhole(row);
    const bool fitted = !below_.planes.empty();
    if (!fitted)
      fitQuarters(row.number);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Quarters planes;
      for (std::size_t q = 0; q < planes.size(); ++q)
        planes[q] = fitted ? &below_.planes[quarter(columns_[k], row.number, q)]
                           : &planes_[planes.size() * k + q];
      const double variance = meanVariance(planes, known_growth_, noise_);
      const FittedPlane& whole = level_.planes[level_.at(columns_[k], row.number)];
      if (variance >= 0)
        ratios.push_back(
            unbiasedRms(whole) /
            std::max(std::sqrt(variance), noise_.small(whole.centroid.norm()) / 4));
    }
  }

private:
  std::size_t quarter(int column, int row, std::size_t number) const
  {
    return below_.at(2 * column + static_cast<int>(number % 2),
                     2 * row + static_cast<int>(number / 2));
  }

  /// Columns of tiles with a plane and four quarters.
  void findWhole(TileRow row)
  {
    columns_.clear();
    if (2 * row.number + 1 >= below_.rows)
      return;
    for (int c = 0; c < level_.columns && 2 * c + 1 < below_.columns; c += row.step)
      if (level_.planes[level_.at(c, row.number)].n >= 4)
        columns_.push_back(c);
  }

  /// Fits planes to the quarters of tiles, of those that have enough points in each: all at
  /// once.
  void fitQuarters(int row)
  {
    sums_.clear();
    std::size_t filled = 0;
    for (const int column : columns_)
      if (areFilled(column, row)) {
        columns_[filled++] = column;
        for (std::size_t q = 0; q < 4; ++q)
          sums_.push_back(below_.sums[quarter(column, row, q)]);
      }
    columns_.resize(filled);
    planes_.resize(std::max(planes_.size(), sums_.size()));
    fitPlanes(sums_.data(), sums_.size(), planes_.data());
  }

  /// The quarters of a tile.
  bool areFilled(int column, int row) const
  {
    for (std::size_t q = 0; q < 4; ++q)
      if (!isFilled(below_, quarter(column, row, q), parameters_))
        return false;
    return true;
  }

  const TileLevel& level_;
  const TileLevel& below_;
  double known_growth_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  // of the row at hand
  FrameVector<int> columns_;
  FrameVector<TileSums> sums_;
  FrameVector<FittedPlane> planes_;
};

/// Growth of the rms distance from tiles' quarters to the tiles.
FrameVector<double> growthRatios(const TileLevel& level, const TileLevel& below,
                                 double known_growth, const NoiseLaw& noise,
                                 const AdaptiveParameters& parameters,
                                 unsigned int threads)
{
  // The smallest tiles have no planes yet; some of them tell enough.
  const int step = below.planes.empty() ? 3 : 1;
  const Bands bands((level.rows + step - 1) / step);
  FrameVector<FrameVector<double>> parts(static_cast<std::size_t>(bands.count));
  parallelParts(bands.count, threads, [&](int band) {
    FrameVector<double>& ratios = parts[static_cast<std::size_t>(band)];
    ratios.reserve(level.planes.size() / parts.size());
    GrowthRatios growth(level, below, known_growth, noise, parameters);
    const int end = std::min(level.rows, step * bands.begin(band + 1));
    for (int r = step * bands.begin(band); r < end; r += step)
      growth.addRow({r, step}, ratios);
  });
  FrameVector<double> ratios;
  ratios.reserve(level.planes.size());
  for (const FrameVector<double>& part : parts)
    ratios.insert(ratios.end(), part.begin(), part.end());
  return ratios;
}

/// Growth of sigma with the level, 1 at the base level, and for planes beyond all levels.
void estimateGrowth(const std::vector<TileLevel>& pyramid,
                    const AdaptiveParameters& parameters, unsigned int threads,
                    NoiseLaw& noise)
{
  constexpr std::size_t FEWEST = 12; // ratios for a percentile
  FrameVector<double> step(pyramid.size(), 1.0);
  double cumulated = 1;
  for (std::size_t l = 1; l < pyramid.size(); ++l) {
    FrameVector<double> ratios =
        growthRatios(pyramid[l], pyramid[l - 1], cumulated, noise, parameters, threads);
    if (ratios.size() >= FEWEST)
      step[l] = std::clamp(percentile(ratios, parameters.growth_percentile), 1.0,
                           parameters.max_growth);
    if (l > BASE)
      cumulated *= step[l];
  }
  noise.growth.assign(pyramid.size(), 1.0);
  for (std::size_t l = BASE + 1; l < pyramid.size(); ++l)
    noise.growth[l] = noise.growth[l - 1] * step[l];
  for (std::size_t l = BASE; l-- > 0;)
    noise.growth[l] = noise.growth[l + 1] / step[l + 1];
  // Correlated noise keeps growing beyond the largest tile; white noise does not.
  const double correlated = std::clamp((noise.growth.back() - 1.05) / 0.25, 0.0, 1.0);
  noise.region = noise.growth.back() * (1 + correlated * (parameters.long_range - 1));
}

} // namespace

namespace {

/// Depth and rms distance of every so many-th of the planes.
FrameVector<Sample> samplePlanes(const std::vector<FittedPlane>& planes,
                                 unsigned int threads)
{
  constexpr std::size_t ENOUGH = 2000; // samples
  // An odd step goes through all columns.
  const std::size_t step = (planes.size() / ENOUGH) | 1U;
  FrameVector<Sample> samples((planes.size() + step - 1) / step);
  parallelRows(static_cast<int>(samples.size()), threads, [&](int number) {
    const auto k = static_cast<std::size_t>(number);
    if (const FittedPlane& p = planes[k * step]; p.n > 3)
      samples[k] = {p.centroid.norm(), unbiasedRms(p)};
    else
      samples[k].rms = -1; // none
  });
  samples.erase(std::remove_if(samples.begin(), samples.end(),
                               [](const Sample& sample) { return sample.rms < 0; }),
                samples.end());
  return samples;
}

} // namespace

NoiseLaw estimateNoise(const std::vector<TileLevel>& pyramid,
                       const AdaptiveParameters& parameters, unsigned int threads)
{
  NoiseLaw noise;
  noise.floor = parameters.min_sigma;
  fitDepthLaw(samplePlanes(pyramid[BASE].planes, threads), parameters.noise_percentile,
              threads, noise);
  estimateGrowth(pyramid, parameters, threads, noise);
  return noise;
}

NoiseLaw statedNoise(const NoiseModel& stated, const std::vector<TileLevel>& pyramid,
                     const AdaptiveParameters& parameters)
{
  NoiseLaw noise;
  noise.a = stated.a;
  noise.b = stated.b;
  noise.c = stated.c;
  noise.floor = parameters.min_sigma;
  noise.growth.assign(pyramid.size(), 1.0);
  return noise;
}

} // namespace pcl_mrf_planes::adaptive
