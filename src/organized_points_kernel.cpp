// SPDX-License-Identifier: BSD-3-Clause
//
// Points of a cloud into planes of coordinates, four or eight at a time.
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

#if HWY_HAVE_SCALABLE || HWY_MAX_BYTES < 32
using Floats = hn::FixedTag<float, 4>;
#else
using Floats = hn::FixedTag<float, 8>;
#endif
using FourFloats = hn::FixedTag<float, 4>;
using FloatVector = hn::Vec<Floats>;
constexpr std::size_t AT_ONCE = hn::MaxLanes(Floats()); // points

/// Brings a line of memory near that is read once, so that it does not drive out others.
HWY_INLINE void prefetchOnce(const float* place)
{
  __builtin_prefetch(place, 0, 0);
}

/// The four numbers of a point; and, behind them, those of the fourth one after it.
HWY_INLINE FloatVector loadPoint(const float* p, std::size_t stride)
{
  const auto lower = hn::LoadU(FourFloats(), p);
#if HWY_HAVE_SCALABLE || HWY_MAX_BYTES < 32
  (void)stride;
  return lower;
#else
  return hn::Combine(Floats(), hn::LoadU(FourFloats(), p + 4 * stride), lower);
#endif
}

/// Pairs of numbers, alternating, of four at a time: the first pair of each, or the second.
HWY_INLINE FloatVector firstPairs(FloatVector a, FloatVector b)
{
  const Floats d;
  const hn::RepartitionToWide<Floats> pairs;
  return hn::BitCast(
      d, hn::InterleaveLower(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
}
HWY_INLINE FloatVector secondPairs(FloatVector a, FloatVector b)
{
  const Floats d;
  const hn::RepartitionToWide<Floats> pairs;
  return hn::BitCast(
      d, hn::InterleaveUpper(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
}

/// Whether the numbers can be coordinates. Written so that NaN and infinity fail.
HWY_INLINE hn::Mask<Floats> isNear(FloatVector numbers)
{
  return hn::Le(hn::Abs(numbers), hn::Set(Floats(), OrganizedPoints::FARTHEST));
}

/// Writes a byte 0 or 1 for each point.
HWY_INLINE void storeBytes(hn::Mask<Floats> mask, std::uint8_t* out)
{
  // Of four points, by the bits of a mask.
  static constexpr std::uint32_t BYTES[16] = {
      0x00000000, 0x00000001, 0x00000100, 0x00000101, 0x00010000, 0x00010001,
      0x00010100, 0x00010101, 0x01000000, 0x01000001, 0x01000100, 0x01000101,
      0x01010000, 0x01010001, 0x01010100, 0x01010101};
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Floats(), mask, bits);
  for (std::size_t k = 0; k < AT_ONCE; k += 4)
    std::memcpy(out + k, &BYTES[(bits[0] >> k) & 15U], sizeof(BYTES[0]));
}

/// \return how many were loaded: the last ones may have no number behind them to read
std::size_t LoadPoints(const float* first, std::size_t stride, std::size_t count,
                       const PointPlanes& out)
{
  const Floats d;
  // So far ahead that memory has answered when the points are read; never past the last one.
  constexpr std::size_t AHEAD = 512;
  constexpr std::size_t LINE = 16; // of the cache, numbers
  const std::size_t lines = (AT_ONCE * stride + LINE - 1) / LINE;
  const PointPlanes to = out; // that the bytes written are not part of, as all can see
  std::size_t i = 0;
  for (; i + AT_ONCE < count; i += AT_ONCE) {
    const float* p = first + i * stride;
    const float* soon = first + std::min(i + AHEAD, count - AT_ONCE) * stride;
    for (std::size_t line = 0; line < lines; ++line)
      prefetchOnce(soon + line * LINE);
    const FloatVector p0 = loadPoint(p, stride);
    const FloatVector p1 = loadPoint(p + stride, stride);
    const FloatVector p2 = loadPoint(p + 2 * stride, stride);
    const FloatVector p3 = loadPoint(p + 3 * stride, stride);
    const FloatVector xy01 = hn::InterleaveLower(d, p0, p1);
    const FloatVector xy23 = hn::InterleaveLower(d, p2, p3);
    const FloatVector x = firstPairs(xy01, xy23);
    const FloatVector y = secondPairs(xy01, xy23);
    const FloatVector z =
        firstPairs(hn::InterleaveUpper(d, p0, p1), hn::InterleaveUpper(d, p2, p3));
    const auto good = hn::And(hn::And(isNear(x), isNear(y)), isNear(z));
    hn::StoreU(hn::IfThenElseZero(good, x), d, to.x + i);
    hn::StoreU(hn::IfThenElseZero(good, y), d, to.y + i);
    hn::StoreU(hn::IfThenElseZero(good, z), d, to.z + i);
    storeBytes(good, to.valid + i);
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
