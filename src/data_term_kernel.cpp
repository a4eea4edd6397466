// SPDX-License-Identifier: BSD-3-Clause
//
// Equation (7) for a row of points. Compiled once for every instruction set that the
// compiler knows; the best one is chosen at run time.
#include "data_term_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "data_term_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
HWY_INLINE hn::Vec<hn::Rebind<std::uint16_t, D>>
costs(D d, const DataTerm& term, const float* x, const float* y, const float* z)
{
  const auto ax = hn::Mul(hn::Set(d, term.a), hn::LoadU(d, x));
  const auto by = hn::Mul(hn::Set(d, term.b), hn::LoadU(d, y));
  const auto cz = hn::Mul(hn::Set(d, term.c), hn::LoadU(d, z));
  const auto sum = hn::Add(hn::Add(ax, by), hn::Add(cz, hn::Set(d, term.d)));
  const auto distance = hn::Min(hn::Abs(sum), hn::Set(d, term.tau));
  const auto units = hn::NearestInt(hn::Mul(distance, hn::Set(d, term.scale)));
  return hn::DemoteTo(hn::Rebind<std::uint16_t, D>(), units);
}

void DataTermRow(const DataTerm& term, const float* x, const float* y, const float* z,
                 std::size_t count, std::uint16_t* cost)
{
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> one;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    hn::StoreU(costs(d, term, x + i, y + i, z + i),
               hn::Rebind<std::uint16_t, decltype(d)>(), cost + i);
  for (; i < count; ++i)
    hn::StoreU(costs(one, term, x + i, y + i, z + i),
               hn::Rebind<std::uint16_t, decltype(one)>(), cost + i);
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(DataTermRow);

void dataTermRow(const DataTerm& term, const float* x, const float* y, const float* z,
                 std::size_t count, std::uint16_t* cost)
{
  HWY_DYNAMIC_DISPATCH(DataTermRow)(term, x, y, z, count, cost);
}

} // namespace pcl_mrf_planes
#endif
