// SPDX-License-Identifier: BSD-3-Clause
//
// Equation (7) and the depth differences of equation (10) for a row of points. Compiled
// once for every instruction set that the compiler knows; the best one is chosen at run
// time.
#include "field_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "field_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Has to come after foreach_target.h.
#include "vector_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class D>
using Units = hn::Rebind<std::uint16_t, D>;

/// 65535 where valid is 1, 0 where it is 0.
template <class D>
HWY_INLINE hn::Vec<Units<D>> mask(D, const std::uint8_t* valid)
{
  const Units<D> u16;
  const auto ones = hn::PromoteTo(u16, hn::LoadU(hn::Rebind<std::uint8_t, D>(), valid));
  return hn::Sub(hn::Zero(u16), ones);
}

void DataTermRow(const DataTerm& term, const float* x, const float* y, const float* z,
                 const std::uint8_t* valid, std::size_t count, std::uint16_t* cost)
{
  ForEachVector(count, [&](auto d, std::size_t i) HWY_ATTR {
    const Units<decltype(d)> u16;
    const auto ax = hn::Mul(hn::Set(d, term.a), hn::LoadU(d, x + i));
    const auto by = hn::Mul(hn::Set(d, term.b), hn::LoadU(d, y + i));
    const auto cz = hn::Mul(hn::Set(d, term.c), hn::LoadU(d, z + i));
    const auto sum = hn::Add(hn::Add(ax, by), hn::Add(cz, hn::Set(d, term.d)));
    const auto distance = hn::Min(hn::Abs(sum), hn::Set(d, term.tau));
    const auto units = hn::NearestInt(hn::Mul(distance, hn::Set(d, term.scale)));
    hn::StoreU(hn::And(hn::DemoteTo(u16, units), mask(d, valid + i)), u16, cost + i);
  });
}

void EdgeWeightRow(const float* depth, const float* other_depth,
                   const std::uint8_t* valid, const std::uint8_t* other_valid,
                   float scale, std::size_t count, std::uint16_t* weight)
{
  constexpr float MOST = 65534.0f;
  ForEachVector(count, [&](auto d, std::size_t i) HWY_ATTR {
    const Units<decltype(d)> u16;
    const auto step =
        hn::Abs(hn::Sub(hn::LoadU(d, depth + i), hn::LoadU(d, other_depth + i)));
    const auto units =
        hn::NearestInt(hn::Min(hn::Mul(step, hn::Set(d, scale)), hn::Set(d, MOST)));
    const auto edge = hn::And(mask(d, valid + i), mask(d, other_valid + i));
    hn::StoreU(hn::Or(hn::DemoteTo(u16, units), hn::Not(edge)), u16, weight + i);
  });
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(DataTermRow);
HWY_EXPORT(EdgeWeightRow);

void dataTermRow(const DataTerm& term, const float* x, const float* y, const float* z,
                 const std::uint8_t* valid, std::size_t count, std::uint16_t* cost)
{
  HWY_DYNAMIC_DISPATCH(DataTermRow)(term, x, y, z, valid, count, cost);
}

void edgeWeightRow(const float* depth, const float* other_depth,
                   const std::uint8_t* valid, const std::uint8_t* other_valid,
                   float scale, std::size_t count, std::uint16_t* weight)
{
  HWY_DYNAMIC_DISPATCH(EdgeWeightRow)
  (depth, other_depth, valid, other_valid, scale, count, weight);
}

} // namespace pcl_mrf_planes
#endif
