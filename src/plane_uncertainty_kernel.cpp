// SPDX-License-Identifier: BSD-3-Clause
//
// Moments of points in the frame of their plane. Compiled once for every instruction set
// that the compiler knows; the best one is chosen at run time.
#include "plane_uncertainty_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plane_uncertainty_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Has to come after foreach_target.h.
#include "vector_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t EIGHT = 8;

template <class D, class V = hn::Vec<D>>
HWY_INLINE V Dot(D d, const double* axis, const PointLanes<V>& p)
{
  return hn::Add(
      hn::Add(hn::Mul(hn::Set(d, axis[0]), p.x), hn::Mul(hn::Set(d, axis[1]), p.y)),
      hn::Mul(hn::Set(d, axis[2]), p.z));
}

/// Adds up every eighth point from k on, as many as there are lanes.
template <class D>
HWY_INLINE void SumLanes(D d, const PlaneFrame& frame, const float* x, const float* y,
                         const float* z, const double* variance, std::size_t count,
                         std::size_t k, double (*lanes)[EIGHT])
{
  using V = hn::Vec<D>;
  const V of_squared = hn::Set(d, frame.of_squared);
  const V of_range = hn::Set(d, frame.of_range);
  V su = hn::Zero(d), sv = su, sr = su, sw = su, swu = su, swv = su, swuu = su,
    swuv = su, swvv = su;
  for (std::size_t i = k; i < count; i += EIGHT) {
    const PointLanes<V> p = LoadPoints(d, x, y, z, i);
    const V u = hn::Sub(Dot(d, frame.right, p), hn::Set(d, frame.u0));
    const V v = hn::Sub(Dot(d, frame.up, p), hn::Set(d, frame.v0));
    const V r = hn::Add(Dot(d, frame.normal, p), hn::Set(d, frame.d));
    const V range =
        hn::Add(hn::Add(hn::Mul(p.x, p.x), hn::Mul(p.y, p.y)), hn::Mul(p.z, p.z));
    const V own = variance != nullptr ? hn::LoadU(d, variance + i)
                                      : hn::Mul(hn::Mul(r, r), of_squared);
    const V w = hn::Add(own, hn::Mul(range, of_range));
    const V wu = hn::Mul(w, u);
    const V wv = hn::Mul(w, v);
    su = hn::Add(su, u);
    sv = hn::Add(sv, v);
    sr = hn::Add(sr, r);
    sw = hn::Add(sw, w);
    swu = hn::Add(swu, wu);
    swv = hn::Add(swv, wv);
    swuu = hn::Add(swuu, hn::Mul(wu, u));
    swuv = hn::Add(swuv, hn::Mul(wu, v));
    swvv = hn::Add(swvv, hn::Mul(wv, v));
  }
  hn::StoreU(su, d, lanes[FrameSums::U] + k);
  hn::StoreU(sv, d, lanes[FrameSums::V] + k);
  hn::StoreU(sr, d, lanes[FrameSums::R] + k);
  hn::StoreU(sw, d, lanes[FrameSums::W] + k);
  hn::StoreU(swu, d, lanes[FrameSums::WU] + k);
  hn::StoreU(swv, d, lanes[FrameSums::WV] + k);
  hn::StoreU(swuu, d, lanes[FrameSums::WUU] + k);
  hn::StoreU(swuv, d, lanes[FrameSums::WUV] + k);
  hn::StoreU(swvv, d, lanes[FrameSums::WVV] + k);
}

/// The points after the last whole eight, one by one.
HWY_INLINE void SumRest(const PlaneFrame& frame, const float* x, const float* y,
                        const float* z, const double* variance, std::size_t count,
                        FrameSums& out)
{
  const hn::CappedTag<double, 1> one;
  double lanes[FrameSums::COUNT][EIGHT];
  for (std::size_t i = 0; i < count; ++i) {
    SumLanes(one, frame, x + i, y + i, z + i,
             variance != nullptr ? variance + i : nullptr, 1, 0, lanes);
    for (std::size_t s = 0; s < FrameSums::COUNT; ++s)
      out.sum[s] += lanes[s][0];
  }
}

void SumInFrame(const PlaneFrame& frame, const float* x, const float* y, const float* z,
                const double* variance, std::size_t count, FrameSums& out)
{
  const hn::CappedTag<double, EIGHT> d;
  const std::size_t whole = count / EIGHT * EIGHT;
  if (whole > 0) {
    double lanes[FrameSums::COUNT][EIGHT];
    for (std::size_t k = 0; k < EIGHT; k += hn::Lanes(d))
      SumLanes(d, frame, x, y, z, variance, whole, k, lanes);
    for (std::size_t s = 0; s < FrameSums::COUNT; ++s) {
      const double* c = lanes[s];
      out.sum[s] = ((c[0] + c[1]) + (c[2] + c[3])) + ((c[4] + c[5]) + (c[6] + c[7]));
    }
  }
  SumRest(frame, x + whole, y + whole, z + whole,
          variance != nullptr ? variance + whole : nullptr, count - whole, out);
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(SumInFrame);

FrameSums sumInFrame(const PlaneFrame& frame, const float* x, const float* y,
                     const float* z, const double* variance, std::size_t count)
{
  FrameSums out;
  HWY_DYNAMIC_DISPATCH(SumInFrame)(frame, x, y, z, variance, count, out);
  return out;
}

} // namespace pcl_mrf_planes
#endif
