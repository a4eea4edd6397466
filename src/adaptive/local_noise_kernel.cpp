// SPDX-License-Identifier: BSD-3-Clause
//
// The noise of cells, some at once. Compiled once for every instruction set that the compiler
// knows; the best one is chosen at run time. Lanes do not depend on one another, so that all
// instruction sets give the same bits.
#include "adaptive/local_noise_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "adaptive/local_noise_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes::adaptive {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// NoiseLaw::small(): sigma at a range.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Small(D d, const NoiseLaw& noise, V range)
{
  const V a = hn::Set(d, noise.a), b = hn::Set(d, noise.b), c = hn::Set(d, noise.c);
  const V law = hn::Add(a, hn::Mul(range, hn::Add(b, hn::Mul(range, c))));
  const V least = hn::Mul(hn::Set(d, noise.floor), hn::Max(range, hn::Set(d, 0.1)));
  return hn::Max(law, least);
}

/// At most CELLS_A_FACTOR cells, which share a factor.
HWY_INLINE void AssignTo(TileSums* cells, std::size_t count, double factor,
                         const NoiseLaw& noise)
{
  const hn::CappedTag<double, CELLS_A_FACTOR> d;
  HWY_ALIGN double n[CELLS_A_FACTOR] = {};
  HWY_ALIGN double x[CELLS_A_FACTOR] = {};
  HWY_ALIGN double y[CELLS_A_FACTOR] = {};
  HWY_ALIGN double z[CELLS_A_FACTOR] = {};
  HWY_ALIGN double sum[CELLS_A_FACTOR];
  for (std::size_t k = 0; k < count; ++k) {
    n[k] = cells[k].n;
    x[k] = cells[k].x;
    y[k] = cells[k].y;
    z[k] = cells[k].z;
  }
  for (std::size_t k = 0; k < CELLS_A_FACTOR; k += hn::Lanes(d)) {
    const auto points = hn::Load(d, n + k);
    const auto px = hn::Load(d, x + k), py = hn::Load(d, y + k),
               pz = hn::Load(d, z + k);
    const auto squares =
        hn::Add(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(pz, pz));
    const auto range = hn::Div(hn::Sqrt(squares), points);
    const auto sigma = hn::Mul(Small(d, noise, range), hn::Set(d, factor));
    const auto some = hn::Ge(points, hn::Set(d, 1.0));
    hn::Store(hn::IfThenElseZero(some, hn::Mul(hn::Mul(points, sigma), sigma)), d,
              sum + k);
  }
  for (std::size_t k = 0; k < count; ++k)
    cells[k].noise = sum[k];
}

void AssignNoise(TileSums* cells, std::size_t count, const double* factors,
                 const NoiseLaw& noise)
{
  std::size_t k = 0;
  for (; k + CELLS_A_FACTOR <= count; k += CELLS_A_FACTOR)
    AssignTo(cells + k, CELLS_A_FACTOR, *factors++, noise);
  if (k < count)
    AssignTo(cells + k, count - k, *factors, noise);
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes::adaptive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes::adaptive {

HWY_EXPORT(AssignNoise);

void assignNoise(TileSums* cells, std::size_t count, const double* factors,
                 const NoiseLaw& noise)
{
  HWY_DYNAMIC_DISPATCH(AssignNoise)(cells, count, factors, noise);
}

} // namespace pcl_mrf_planes::adaptive
#endif
