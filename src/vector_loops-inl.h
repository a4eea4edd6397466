// SPDX-License-Identifier: BSD-3-Clause
//
// What kernels share, compiled with each of them for every instruction set.
#if defined(PCL_MRF_PLANES_VECTOR_LOOPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PCL_MRF_PLANES_VECTOR_LOOPS_INL_H
#undef PCL_MRF_PLANES_VECTOR_LOOPS_INL_H
#else
#define PCL_MRF_PLANES_VECTOR_LOOPS_INL_H
#endif

#include <cstddef>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

/// Calls block(d, i) for vectors of so many numbers and then for the single ones that are
/// left.
template <class Block>
HWY_INLINE void ForEachVector(std::size_t count, Block&& block)
{
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    block(d, i);
  for (; i < count; ++i)
    block(one, i);
}

/// Coordinates of as many points as there are lanes.
template <class V>
struct PointLanes {
  V x, y, z;
};

/// Those from the i-th on, in double precision.
template <class D>
HWY_INLINE PointLanes<hwy::HWY_NAMESPACE::Vec<D>>
LoadPoints(D d, const float* x, const float* y, const float* z, std::size_t i)
{
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::Rebind<float, D> f;
  return {hn::PromoteTo(d, hn::LoadU(f, x + i)), hn::PromoteTo(d, hn::LoadU(f, y + i)),
          hn::PromoteTo(d, hn::LoadU(f, z + i))};
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#endif
