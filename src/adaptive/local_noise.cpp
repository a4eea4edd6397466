// SPDX-License-Identifier: BSD-3-Clause
//
// The noise of each tile: the law of the cloud, raised where the tiles around all show more.
#include "adaptive/local_noise_kernel.h"
#include "adaptive/noise_estimation.h"
#include "adaptive/tile_rms.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Noise of the points of each tile over that of the whole cloud; 0 where it has no plane.
FrameVector<double> noiseRatios(const TileLevel& level, const NoiseLaw& noise,
                                unsigned int threads)
{
  FrameVector<double> ratios(level.planes.size(), 0.0);
  parallelRows(level.rows, threads, [&](int r) {
    for (std::size_t i = level.at(0, r); i < level.at(0, r + 1); ++i)
      if (const FittedPlane& p = level.planes[i]; p.n > 3)
        ratios[i] = unbiasedRms(p) / noise.small(p.centroid.norm());
  });
  return ratios;
}

/// A rectangle of tiles, half open.
struct TileWindow {
  int left, right, top, bottom;
};

/// Tiles with a plane, and those of them that show no more noise than the whole cloud.
struct TileCount {
  int with_plane = 0;
  int quiet = 0;

  friend TileCount operator+(const TileCount& a, const TileCount& b)
  {
    return {a.with_plane + b.with_plane, a.quiet + b.quiet};
  }
  friend TileCount operator-(const TileCount& a, const TileCount& b)
  {
    return {a.with_plane - b.with_plane, a.quiet - b.quiet};
  }
};

/// Counts the tiles of any window: from sums over all that lie above and to the left.
class TileCounts {
public:
  TileCounts(const TileLevel& level, const FrameVector<double>& ratios,
             unsigned int threads)
  : stride_(static_cast<std::size_t>(level.columns) + 1)
  , sums_(stride_ * (static_cast<std::size_t>(level.rows) + 1))
  {
    parallelRows(level.rows, threads, [&](int r) {
      TileCount row;
      for (int c = 0; c < level.columns; ++c) {
        const double ratio = ratios[level.at(c, r)];
        row = row + TileCount{ratio > 0 ? 1 : 0, ratio > 0 && ratio <= 1 ? 1 : 0};
        sums_[at(c + 1, r + 1)] = row;
      }
    });
    for (std::size_t k = stride_; k < sums_.size(); ++k)
      sums_[k] = sums_[k - stride_] + sums_[k];
  }

  TileCount in(const TileWindow& window) const
  {
    return sums_[at(window.right, window.bottom)] -
           sums_[at(window.left, window.bottom)] - sums_[at(window.right, window.top)] +
           sums_[at(window.left, window.top)];
  }

private:
  std::size_t at(int column, int row) const
  {
    return static_cast<std::size_t>(row) * stride_ + static_cast<std::size_t>(column);
  }

  std::size_t stride_;
  FrameVector<TileCount> sums_;
};

/// Noise around each square of 2x2 tiles of a level over that of the whole cloud: a low
/// percentile of the tiles near, so that edges do not count.
FrameVector<double> localFactors(const TileLevel& level, const TileLevel& squares,
                                 const NoiseLaw& noise,
                                 const AdaptiveParameters& parameters,
                                 unsigned int threads)
{
  constexpr int FEWEST = 4; // tiles for a percentile
  const int reach = parameters.local_reach;
  const FrameVector<double> ratios = noiseRatios(level, noise, threads);
  const TileCounts counts(level, ratios, threads);
  FrameVector<double> factors(squares.at(0, squares.rows), 1.0);
  const auto findRow = [&](int r, FrameVector<double>& around) {
    for (int c = 0; c < squares.columns; ++c) {
      const TileWindow window = {
          std::max(0, 2 * c - reach), std::min(level.columns, 2 * c + 2 + reach),
          std::max(0, 2 * r - reach), std::min(level.rows, 2 * r + 2 + reach)};
      const auto [tiles, quiet] = counts.in(window);
      if (tiles < FEWEST || quiet > parameters.local_percentile * tiles)
        continue;
      around.clear();
      for (int j = window.top; j < window.bottom; ++j)
        for (int i = window.left; i < window.right; ++i)
          if (const double ratio = ratios[level.at(i, j)]; ratio > 0)
            around.push_back(ratio);
      factors[squares.at(c, r)] = std::clamp(
          percentile(around, parameters.local_percentile), 1.0, parameters.max_local);
    }
  };
  const Bands bands(squares.rows);
  parallelParts(bands.count, threads, [&](int band) {
    FrameVector<double> around;
    for (int r = bands.begin(band); r < bands.begin(band + 1); ++r)
      findRow(r, around);
  });
  return factors;
}

/// Pools the noise of the level below for a row of tiles, and tells it to the planes.
void poolNoise(const TileLevel& below, TileLevel& level, int row)
{
  for (int c = 0; c < level.columns; ++c) {
    TileSums& sums = level.sums[level.at(c, row)];
    if (sums.n < 1)
      continue;
    sums.noise = 0;
    for (int j = 2 * row; j < std::min(2 * row + 2, below.rows); ++j)
      for (int k = 2 * c; k < std::min(2 * c + 2, below.columns); ++k)
        sums.noise += below.sums[below.at(k, j)].noise;
    level.planes[level.at(c, row)].noise = sums.noise / sums.n;
  }
}

} // namespace

void assignLocalNoise(std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                      const AdaptiveParameters& parameters, unsigned int threads)
{
  // Squares of 2x2 tiles of the base level are the tiles of the level above, if there is
  // one.
  TileLevel squares;
  squares.columns = (pyramid[BASE].columns + 1) / 2;
  squares.rows = (pyramid[BASE].rows + 1) / 2;
  const FrameVector<double> factors =
      localFactors(pyramid[BASE], squares, noise, parameters, threads);
  TileLevel& cells = pyramid[0];
  static_assert((CELLS_A_FACTOR >> BASE) == 2, "cells of a square, each way");
  constexpr int CELLS = CELLS_A_FACTOR;
  // Two rows of cells are still near when the row of tiles that they make up asks for them.
  TileLevel& pairs = pyramid[1];
  parallelRows(pairs.rows, threads, [&](int row) {
    for (int r = 2 * row; r < std::min(2 * row + 2, cells.rows); ++r)
      assignNoise(&cells.sums[cells.at(0, r)], static_cast<std::size_t>(cells.columns),
                  &factors[squares.at(0, r / CELLS)], noise);
    poolNoise(cells, pairs, row);
  });
  for (std::size_t l = 2; l < pyramid.size(); ++l)
    parallelRows(pyramid[l].rows, threads,
                 [&](int row) { poolNoise(pyramid[l - 1], pyramid[l], row); });
}

} // namespace pcl_mrf_planes::adaptive
