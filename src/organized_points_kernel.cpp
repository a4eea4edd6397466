// SPDX-License-Identifier: BSD-3-Clause
//
// Points of a cloud into planes of coordinates, four at a time: memory bounds it, so that
// wider vectors would not help.
#include "organized_points_kernel.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "organized_points_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

std::size_t LoadPoints(const float* /*first*/, std::size_t /*stride*/,
                       std::size_t /*count*/, const PointPlanes& /*out*/)
{
  return 0; // all are left to the plain loop
}

#else

/// Brings a line of memory near that is read once, so that it does not drive out others.
HWY_INLINE void prefetchOnce(const float* place)
{
  __builtin_prefetch(place, 0, 0);
}

/// \return how many were loaded: the last ones may have no number behind them to read
std::size_t LoadPoints(const float* first, std::size_t stride, std::size_t count,
                       const PointPlanes& out)
{
  const hn::FixedTag<float, 4> d;
  using V = hn::Vec<decltype(d)>;
  // The bytes 0 or 1 of four points, by the bits of a mask.
  constexpr std::uint32_t BYTES[16] = {0x00000000, 0x00000001, 0x00000100, 0x00000101,
                                       0x00010000, 0x00010001, 0x00010100, 0x00010101,
                                       0x01000000, 0x01000001, 0x01000100, 0x01000101,
                                       0x01010000, 0x01010001, 0x01010100, 0x01010101};
  const V farthest = hn::Set(d, OrganizedPoints::FARTHEST);
  // So far ahead that memory has answered when the points are read; never past the last one.
  constexpr std::size_t AHEAD = 512;
  const bool is_wide = stride > 4; // four points take more than a line of the cache
  std::size_t i = 0;
  for (; i + 4 < count; i += 4) {
    const float* p = first + i * stride;
    const float* soon = first + std::min(i + AHEAD, count - 4) * stride;
    prefetchOnce(soon);
    if (is_wide)
      prefetchOnce(soon + 2 * stride);
    const V p0 = hn::LoadU(d, p);
    const V p1 = hn::LoadU(d, p + stride);
    const V p2 = hn::LoadU(d, p + 2 * stride);
    const V p3 = hn::LoadU(d, p + 3 * stride);
    const V xy01 = hn::InterleaveLower(d, p0, p1);
    const V xy23 = hn::InterleaveLower(d, p2, p3);
    const V x = hn::ConcatLowerLower(d, xy23, xy01);
    const V y = hn::ConcatUpperUpper(d, xy23, xy01);
    const V z = hn::ConcatLowerLower(d, hn::InterleaveUpper(d, p2, p3),
                                     hn::InterleaveUpper(d, p0, p1));
    // Written so that NaN and infinity fail.
    const auto good =
        hn::And(hn::And(hn::Le(hn::Abs(x), farthest), hn::Le(hn::Abs(y), farthest)),
                hn::Le(hn::Abs(z), farthest));
    hn::StoreU(hn::IfThenElseZero(good, x), d, out.x + i);
    hn::StoreU(hn::IfThenElseZero(good, y), d, out.y + i);
    hn::StoreU(hn::IfThenElseZero(good, z), d, out.z + i);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, good, bits);
    std::memcpy(out.valid + i, &BYTES[bits[0]], sizeof(BYTES[0]));
  }
  return i;
}

#endif

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(LoadPoints);

std::size_t loadPoints(const float* first, std::size_t stride, std::size_t count,
                       const PointPlanes& out)
{
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
                "the first of four bytes is the lowest");
  return HWY_DYNAMIC_DISPATCH(LoadPoints)(first, stride, count, out);
}

} // namespace pcl_mrf_planes
#endif
