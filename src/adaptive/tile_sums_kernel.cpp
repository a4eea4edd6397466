// SPDX-License-Identifier: BSD-3-Clause
//
// Equation (4) for strips of small tiles. Compiled once for every instruction set that the
// compiler knows; the best one is chosen at run time.
#include "adaptive/tile_sums_kernel.h"

#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "adaptive/tile_sums_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes::adaptive {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t COLUMNS = 4; // of a tile
constexpr std::size_t SUMS = 9;    // of a column, but for the number of points

/// Adds a few columns of a tile, downwards.
template <class D>
HWY_INLINE void sumColumns(D d, const TileStrip& strip, std::size_t first,
                           double* columns)
{
  const hn::Rebind<float, D> f;
  auto x = hn::Zero(d), y = x, z = x, xx = x, xy = x, xz = x, yy = x, yz = x, zz = x;
  for (int r = 0; r < strip.rows; ++r) {
    const std::size_t i = static_cast<std::size_t>(r) * strip.width + first;
    const auto px = hn::PromoteTo(d, hn::LoadU(f, strip.x + i));
    const auto py = hn::PromoteTo(d, hn::LoadU(f, strip.y + i));
    const auto pz = hn::PromoteTo(d, hn::LoadU(f, strip.z + i));
    x = hn::Add(x, px);
    y = hn::Add(y, py);
    z = hn::Add(z, pz);
    xx = hn::Add(xx, hn::Mul(px, px));
    xy = hn::Add(xy, hn::Mul(px, py));
    xz = hn::Add(xz, hn::Mul(px, pz));
    yy = hn::Add(yy, hn::Mul(py, py));
    yz = hn::Add(yz, hn::Mul(py, pz));
    zz = hn::Add(zz, hn::Mul(pz, pz));
  }
  hn::StoreU(x, d, columns);
  hn::StoreU(y, d, columns + COLUMNS);
  hn::StoreU(z, d, columns + 2 * COLUMNS);
  hn::StoreU(xx, d, columns + 3 * COLUMNS);
  hn::StoreU(xy, d, columns + 4 * COLUMNS);
  hn::StoreU(xz, d, columns + 5 * COLUMNS);
  hn::StoreU(yy, d, columns + 6 * COLUMNS);
  hn::StoreU(yz, d, columns + 7 * COLUMNS);
  hn::StoreU(zz, d, columns + 8 * COLUMNS);
}

/// Valid points of a tile: the ones of four bytes are added up in one word.
HWY_INLINE double countPoints(const TileStrip& strip, std::size_t first)
{
  std::uint32_t ones = 0;
  for (int r = 0; r < strip.rows; ++r) {
    std::uint32_t word = 0;
    std::memcpy(&word, strip.valid + static_cast<std::size_t>(r) * strip.width + first,
                sizeof(word));
    ones += word;
  }
  return static_cast<double>((ones * 0x01010101U) >> 24U);
}

void SumTiles(const TileStrip& strip, std::size_t tiles, TileSums* sums)
{
  const hn::CappedTag<double, COLUMNS> d;
  double columns[SUMS * COLUMNS];
  for (std::size_t t = 0; t < tiles; ++t) {
    for (std::size_t k = 0; k < COLUMNS; k += hn::Lanes(d))
      sumColumns(d, strip, COLUMNS * t + k, columns + k);
    const auto total = [&](std::size_t s) {
      const double* c = columns + s * COLUMNS;
      return (c[0] + c[1]) + (c[2] + c[3]);
    };
    TileSums& sum = sums[t];
    sum.n = countPoints(strip, COLUMNS * t);
    sum.x = total(0);
    sum.y = total(1);
    sum.z = total(2);
    sum.xx = total(3);
    sum.xy = total(4);
    sum.xz = total(5);
    sum.yy = total(6);
    sum.yz = total(7);
    sum.zz = total(8);
    sum.noise = 0;
  }
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes::adaptive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes::adaptive {

HWY_EXPORT(SumTiles);

void sumTiles(const TileStrip& strip, std::size_t tiles, TileSums* sums)
{
  HWY_DYNAMIC_DISPATCH(SumTiles)(strip, tiles, sums);
}

} // namespace pcl_mrf_planes::adaptive
#endif
