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

/// Sums of a few columns of a tile, in the order of ScatterMatrix.
template <class V>
struct ColumnSums {
  V x, y, z, xx, xy, xz, yy, yz, zz;
};

/// Adds a few columns of a tile, downwards.
template <class D, class V = hn::Vec<D>>
HWY_INLINE ColumnSums<V> sumColumns(D d, const TileStrip& strip, std::size_t first)
{
  const hn::Rebind<float, D> f;
  const V none = hn::Zero(d);
  ColumnSums<V> s = {none, none, none, none, none, none, none, none, none};
  for (int r = 0; r < strip.rows; ++r) {
    const std::size_t i = static_cast<std::size_t>(r) * strip.width + first;
    const V x = hn::PromoteTo(d, hn::LoadU(f, strip.x + i));
    const V y = hn::PromoteTo(d, hn::LoadU(f, strip.y + i));
    const V z = hn::PromoteTo(d, hn::LoadU(f, strip.z + i));
    s.x = hn::Add(s.x, x);
    s.y = hn::Add(s.y, y);
    s.z = hn::Add(s.z, z);
    s.xx = hn::Add(s.xx, hn::Mul(x, x));
    s.xy = hn::Add(s.xy, hn::Mul(x, y));
    s.xz = hn::Add(s.xz, hn::Mul(x, z));
    s.yy = hn::Add(s.yy, hn::Mul(y, y));
    s.yz = hn::Add(s.yz, hn::Mul(y, z));
    s.zz = hn::Add(s.zz, hn::Mul(z, z));
  }
  return s;
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

#if HWY_HAVE_SCALABLE || HWY_MAX_BYTES < 32
/// Adds a tile up, over its columns.
HWY_INLINE void sumTile(const TileStrip& strip, std::size_t first, double* sums)
{
  const hn::CappedTag<double, COLUMNS> d;
  double columns[SUMS][COLUMNS];
  for (std::size_t k = 0; k < COLUMNS; k += hn::Lanes(d)) {
    const auto s = sumColumns(d, strip, first + k);
    std::size_t number = 0;
    for (const auto& v : {s.x, s.y, s.z, s.xx, s.xy, s.xz, s.yy, s.yz, s.zz})
      hn::StoreU(v, d, columns[number++] + k);
  }
  // All columns have been stored, which clang-tidy cannot know.
  // NOLINTBEGIN(clang-analyzer-core.UndefinedBinaryOperatorResult)
  for (std::size_t k = 0; k < SUMS; ++k)
    sums[k] = (columns[k][0] + columns[k][1]) + (columns[k][2] + columns[k][3]);
  // NOLINTEND(clang-analyzer-core.UndefinedBinaryOperatorResult)
}
#else
using Columns = hn::FixedTag<double, COLUMNS>;
using FourSums = hn::Vec<Columns>;

/// The sums over the columns of two numbers, still in two parts: 1st + 2nd, 3rd + 4th.
HWY_INLINE FourSums addPairs(FourSums a, FourSums b)
{
  const Columns d;
  return hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b));
}

/// The sums over the columns of four numbers, of which pairs are in two parts.
HWY_INLINE FourSums addHalves(FourSums first, FourSums second)
{
  const Columns d;
  return hn::Add(hn::ConcatLowerLower(d, second, first),
                 hn::ConcatUpperUpper(d, second, first));
}

/// Adds a tile up, over its columns, all of which are one vector.
HWY_INLINE void sumTile(const TileStrip& strip, std::size_t first, double* sums)
{
  const Columns d;
  const ColumnSums<FourSums> s = sumColumns(d, strip, first);
  hn::StoreU(addHalves(addPairs(s.x, s.y), addPairs(s.z, s.xx)), d, sums);
  hn::StoreU(addHalves(addPairs(s.xy, s.xz), addPairs(s.yy, s.yz)), d, sums + 4);
  const FourSums zz = addPairs(s.zz, s.zz);
  sums[8] = hn::GetLane(addHalves(zz, zz));
}
#endif

void SumTiles(const TileStrip& strip, std::size_t tiles, TileSums* sums)
{
  static_assert(sizeof(ScatterMatrix) == (1 + SUMS) * sizeof(double),
                "the number of points and the sums in a row");
  for (std::size_t t = 0; t < tiles; ++t) {
    TileSums& sum = sums[t];
    sumTile(strip, COLUMNS * t, &sum.n + 1);
    sum.n = countPoints(strip, COLUMNS * t);
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
