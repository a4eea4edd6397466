// SPDX-License-Identifier: BSD-3-Clause
//
// Gaps between labels, a row of a block at a time. Compiled once for every instruction set
// that the compiler knows; the best one is chosen at run time. Lanes do not depend on one
// another, and products and sums are not fused: all of them give the same bits.
#include "adaptive/label_gap_kernel.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "adaptive/label_gap_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Has to come after foreach_target.h.
#include "vector_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes::adaptive {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using pcl_mrf_planes::HWY_NAMESPACE::ForEachVector;

constexpr std::size_t EIGHT = 8;

template <class D>
using Labels = hn::Rebind<std::uint16_t, D>;
template <class D>
using Numbers = hn::Rebind<std::int32_t, D>;

/// Where bytes are not 0.
template <class D>
HWY_INLINE hn::Mask<D> Where(D d, const std::uint8_t* bytes)
{
  const Numbers<D> i32;
  const auto numbers =
      hn::PromoteTo(i32, hn::LoadU(hn::Rebind<std::uint8_t, D>(), bytes));
  return hn::RebindMask(d, hn::Ne(numbers, hn::Zero(i32)));
}

/// Where points have a label.
template <class D>
HWY_INLINE hn::Mask<D> Have(D d, std::uint16_t label, const std::uint16_t* labels)
{
  const Numbers<D> i32;
  const auto numbers = hn::PromoteTo(i32, hn::LoadU(Labels<D>(), labels));
  return hn::RebindMask(d, hn::Eq(numbers, hn::Set(i32, label)));
}

void EdgePriceRow(const EdgePrices& prices, const float* a, const float* b,
                  const std::uint8_t* a_valid, const std::uint8_t* b_valid,
                  const float* per_step, std::size_t count, float* out)
{
  ForEachVector(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto one = hn::Set(d, 1.0f);
    const auto step = hn::Mul(hn::Sub(hn::LoadU(d, a + i), hn::LoadU(d, b + i)),
                              hn::LoadU(d, per_step + i));
    const auto share = hn::Max(hn::Div(one, hn::Add(one, hn::Mul(step, step))),
                               hn::Set(d, prices.least));
    const auto edge = hn::And(Where(d, a_valid + i), Where(d, b_valid + i));
    hn::StoreU(hn::IfThenElseZero(edge, hn::Mul(hn::Set(d, prices.price), share)), d,
               out + i);
  });
}

/// Equation (7) in sigmas.
template <class D>
HWY_INLINE hn::Vec<D> Data(D d, const GapCosts& costs, const GapRow& row,
                           const GapCandidate& c, std::size_t k)
{
  if (c.label == 0)
    return hn::Set(d, costs.none);
  const auto ax = hn::Mul(hn::Set(d, c.a), hn::LoadU(d, row.x + k));
  const auto by = hn::Mul(hn::Set(d, c.b), hn::LoadU(d, row.y + k));
  const auto cz = hn::Mul(hn::Set(d, c.c), hn::LoadU(d, row.z + k));
  const auto sum = hn::Add(hn::Add(hn::Add(ax, by), cz), hn::Set(d, c.d));
  return hn::Min(hn::Mul(hn::Abs(sum), hn::Set(d, c.per_sigma)),
                 hn::Set(d, costs.most));
}

/// Where all points around have the label of the points, which are the same.
template <class D>
HWY_INLINE void GapsInside(D d, const GapCosts& costs, const GapRow& row,
                           const GapCandidate* candidates, std::size_t count,
                           std::size_t k, float* gaps)
{
  const std::uint16_t mine = row.labels[0];
  auto own = hn::Set(d, mine == 0 ? costs.none : costs.most);
  auto least = hn::Set(d, mine == 0 ? costs.none : std::numeric_limits<float>::max());
  for (std::size_t s = 0; s < count; ++s) {
    const auto cost = Data(d, costs, row, candidates[s], k);
    if (candidates[s].label == mine)
      own = cost;
    else
      least = hn::Min(cost, least);
  }
  auto gap = hn::Add(hn::Sub(least, own), hn::LoadU(d, row.right + k - 1));
  gap = hn::Add(gap, hn::LoadU(d, row.right + k));
  gap = hn::Add(gap, hn::LoadU(d, row.above + k));
  gap = hn::Add(gap, hn::LoadU(d, row.below + k));
  hn::StoreU(hn::Max(gap, hn::Zero(d)), d, gaps + k);
}

/// What a label saves where neighbours have it as well.
template <class D>
HWY_INLINE hn::Vec<D> Saved(D d, const GapRow& row, std::uint16_t label, std::size_t k)
{
  auto sum = hn::IfThenElseZero(Have(d, label, row.labels + k - 1),
                                hn::LoadU(d, row.right + k - 1));
  sum = hn::Add(sum, hn::IfThenElseZero(Have(d, label, row.labels + k + 1),
                                        hn::LoadU(d, row.right + k)));
  sum = hn::Add(sum, hn::IfThenElseZero(Have(d, label, row.labels_above + k),
                                        hn::LoadU(d, row.above + k)));
  return hn::Add(sum, hn::IfThenElseZero(Have(d, label, row.labels_below + k),
                                         hn::LoadU(d, row.below + k)));
}

template <class D>
HWY_INLINE void GapsAnywhere(D d, const GapCosts& costs, const GapRow& row,
                             const GapCandidate* candidates, std::size_t count,
                             std::size_t k, float* gaps)
{
  // "No plane" stands beside a plane that was not found and fits no better.
  const auto none = Have(d, 0, row.labels + k);
  auto own = hn::Set(d, costs.most);
  auto least = hn::IfThenElse(none, hn::Set(d, costs.none),
                              hn::Set(d, std::numeric_limits<float>::max()));
  for (std::size_t s = 0; s < count; ++s) {
    const GapCandidate& c = candidates[s];
    const auto cost = hn::Sub(Data(d, costs, row, c, k), Saved(d, row, c.label, k));
    const auto mine = Have(d, c.label, row.labels + k);
    own = hn::IfThenElse(mine, cost, own);
    least = hn::IfThenElse(mine, least, hn::Min(cost, least));
  }
  hn::StoreU(hn::Max(hn::Sub(least, own), hn::Zero(d)), d, gaps + k);
}

/// Whether eight points and all their neighbours have one label.
HWY_INLINE bool AllAgree(const GapRow& row)
{
  const hn::CappedTag<std::uint16_t, EIGHT> d;
  const auto mine = hn::Set(d, row.labels[0]);
  auto differ = hn::Zero(d);
  for (std::size_t k = 0; k < EIGHT; k += hn::Lanes(d))
    for (const std::uint16_t* labels :
         {row.labels - 1, row.labels + 1, row.labels_above, row.labels_below})
      differ = hn::Or(differ, hn::Xor(hn::LoadU(d, labels + k), mine));
  return hn::AllTrue(d, hn::Eq(differ, hn::Zero(d)));
}

void GapsOfEight(const GapCosts& costs, const GapRow& row,
                 const GapCandidate* candidates, std::size_t count, float* gaps)
{
  const hn::CappedTag<float, EIGHT> d;
  const bool inside = AllAgree(row);
  for (std::size_t k = 0; k < EIGHT; k += hn::Lanes(d))
    if (inside)
      GapsInside(d, costs, row, candidates, count, k, gaps);
    else
      GapsAnywhere(d, costs, row, candidates, count, k, gaps);
}

/// exp(-x) for x of 0 or more: 2^-k times the Taylor series of 2^-f, f at most a half.
template <class D>
HWY_INLINE hn::Vec<D> FallingExponential(D d, hn::Vec<D> x)
{
  const Numbers<D> i32;
  constexpr float LOG2_E = 1.44269504f;
  constexpr float LN_2 = 0.69314718f;
  const auto y = hn::Mul(hn::Min(x, hn::Set(d, 80.0f)), hn::Set(d, LOG2_E));
  const auto whole = hn::NearestInt(y);
  const auto t = hn::Mul(hn::Sub(hn::ConvertTo(d, whole), y), hn::Set(d, LN_2));
  auto p = hn::Set(d, 1.0f / 720);
  for (const float c : {1.0f / 120, 1.0f / 24, 1.0f / 6, 0.5f, 1.0f, 1.0f})
    p = hn::Add(hn::Mul(p, t), hn::Set(d, c));
  const auto power = hn::ShiftLeft<23>(hn::Sub(hn::Set(i32, 127), whole));
  return hn::Mul(p, hn::BitCast(d, power));
}

void GapsToShares(const GapExponent& exponent, const std::uint8_t* valid,
                  std::size_t count, float* gaps)
{
  ForEachVector(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto gap = hn::LoadU(d, gaps + i);
    const auto slope = hn::Add(hn::Set(d, exponent.linear),
                               hn::Mul(hn::Set(d, exponent.squared), gap));
    const auto x = hn::Mul(gap, slope);
    const auto one = hn::Set(d, 1.0f);
    const auto share = hn::Max(hn::Sub(one, FallingExponential(d, x)), hn::Zero(d));
    hn::StoreU(hn::IfThenElseZero(Where(d, valid + i), share), d, gaps + i);
  });
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes::adaptive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes::adaptive {

HWY_EXPORT(EdgePriceRow);
HWY_EXPORT(GapsOfEight);
HWY_EXPORT(GapsToShares);

void edgePriceRow(const EdgePrices& prices, const float* a, const float* b,
                  const std::uint8_t* a_valid, const std::uint8_t* b_valid,
                  const float* per_step, std::size_t count, float* out)
{
  HWY_DYNAMIC_DISPATCH(EdgePriceRow)
  (prices, a, b, a_valid, b_valid, per_step, count, out);
}

void gapsOfEight(const GapCosts& costs, const GapRow& row,
                 const GapCandidate* candidates, std::size_t count, float* gaps)
{
  HWY_DYNAMIC_DISPATCH(GapsOfEight)(costs, row, candidates, count, gaps);
}

void gapsToShares(const GapExponent& exponent, const std::uint8_t* valid,
                  std::size_t count, float* gaps)
{
  HWY_DYNAMIC_DISPATCH(GapsToShares)(exponent, valid, count, gaps);
}

} // namespace pcl_mrf_planes::adaptive
#endif
