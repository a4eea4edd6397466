// SPDX-License-Identifier: BSD-3-Clause
//
// Equation (3) for many tiles at once, one to a lane. Compiled once for every instruction
// set that the compiler knows; the best one is chosen at run time. Lanes do not depend on
// one another, so that all instruction sets give the same bits.
#include "adaptive/tile_sums.h"

#include <array>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "adaptive/plane_fit_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes::adaptive {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Three coordinates of a vector, a tile to a lane.
template <class V>
struct Vectors {
  V x, y, z;
};

template <class V>
HWY_INLINE V Dot(const Vectors<V>& a, const Vectors<V>& b)
{
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

template <class V>
HWY_INLINE Vectors<V> Cross(const Vectors<V>& a, const Vectors<V>& b)
{
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

template <class V, class M>
HWY_INLINE Vectors<V> Select(M mask, const Vectors<V>& yes, const Vectors<V>& no)
{
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// Covariance matrices, symmetric, and what the characteristic polynomial is made of.
template <class V>
struct Covariances {
  V xx, xy, xz, yy, yz, zz;

  V Trace() const { return hn::Add(hn::Add(xx, yy), zz); }
  V Minors() const
  {
    const V a = hn::Sub(hn::Mul(xx, yy), hn::Mul(xy, xy));
    const V b = hn::Sub(hn::Mul(xx, zz), hn::Mul(xz, xz));
    const V c = hn::Sub(hn::Mul(yy, zz), hn::Mul(yz, yz));
    return hn::Add(hn::Add(a, b), c);
  }
  V Determinant() const
  {
    const V a = hn::Mul(xx, hn::Sub(hn::Mul(yy, zz), hn::Mul(yz, yz)));
    const V b = hn::Mul(xy, hn::Sub(hn::Mul(xy, zz), hn::Mul(yz, xz)));
    const V c = hn::Mul(xz, hn::Sub(hn::Mul(xy, yz), hn::Mul(yy, xz)));
    return hn::Add(hn::Sub(a, b), c);
  }
  /// Mean square along a direction of unit length.
  V Along(const Vectors<V>& n) const
  {
    const Vectors<V> rows = {Dot<V>({xx, xy, xz}, n), Dot<V>({xy, yy, yz}, n),
                             Dot<V>({xz, yz, zz}, n)};
    return Dot(rows, n);
  }
};

/// Least root of the characteristic polynomial by Newton's method from 0, which rises to
/// it: in two or three steps where the points are flat.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V LeastEigenvalue(D d, V trace, V minors, V determinant)
{
  constexpr int STEPS = 6;
  const V close = hn::Set(d, 1e-7);
  V root = hn::Zero(d);
  auto rising = hn::Eq(root, root);
  for (int k = 0; k < STEPS; ++k) {
    const V slope = hn::Add(
        hn::Mul(hn::Sub(hn::Mul(hn::Set(d, 3.0), root), hn::Add(trace, trace)), root),
        minors);
    const V value =
        hn::Sub(hn::Mul(hn::Add(hn::Mul(hn::Sub(root, trace), root), minors), root),
                determinant);
    rising = hn::And(rising, hn::Gt(slope, hn::Zero(d)));
    const V step = hn::Div(hn::Neg(value), slope);
    root = hn::IfThenElse(rising, hn::Add(root, step), root);
    rising = hn::And(rising, hn::Gt(step, hn::Mul(close, root)));
    if (hn::AllFalse(d, rising))
      break;
  }
  return hn::Max(root, hn::Zero(d));
}

/// Null vectors of the covariances less the eigenvalues: the longest cross product of rows.
/// Points on a line, or in one spot, get the z axis: any normal will do.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Vectors<V> Normals(D d, const Covariances<V>& c, V root)
{
  const Vectors<V> r0 = {hn::Sub(c.xx, root), c.xy, c.xz};
  const Vectors<V> r1 = {c.xy, hn::Sub(c.yy, root), c.yz};
  const Vectors<V> r2 = {c.xz, c.yz, hn::Sub(c.zz, root)};
  Vectors<V> best = Cross(r0, r1);
  V length = Dot(best, best);
  for (const Vectors<V>& other : {Cross(r0, r2), Cross(r1, r2)}) {
    const V other_length = Dot(other, other);
    best = Select(hn::Gt(other_length, length), other, best);
    length = hn::Max(length, other_length);
  }
  const V norm = hn::Sqrt(length);
  const auto found = hn::Gt(length, hn::Zero(d));
  const Vectors<V> unit = {hn::Div(best.x, norm), hn::Div(best.y, norm),
                           hn::Div(best.z, norm)};
  return Select<V>(found, unit, {hn::Zero(d), hn::Zero(d), hn::Set(d, 1.0)});
}

constexpr std::size_t NUMBERS = 11; // of a TileSums
constexpr std::size_t RESULTS = 10; // of a FittedPlane, without n and noise

/// Numbers of as many tiles as there are lanes, by number.
template <class D, std::size_t N>
struct Table {
  HWY_ALIGN double at[N][hn::MaxLanes(D())];

  hn::Vec<D> Load(D d, std::size_t k) const { return hn::LoadU(d, at[k]); }
  void Store(hn::Vec<D> v, D d, std::size_t k) { hn::StoreU(v, d, at[k]); }
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE void FitTable(D d, const Table<D, NUMBERS>& in, Table<D, RESULTS>& out)
{
  const V per = hn::Div(hn::Set(d, 1.0), in.Load(d, 0));
  const Vectors<V> mean = {hn::Mul(in.Load(d, 1), per), hn::Mul(in.Load(d, 2), per),
                           hn::Mul(in.Load(d, 3), per)};
  const auto central = [&](std::size_t k, V a, V b) {
    return hn::Sub(hn::Mul(in.Load(d, k), per), hn::Mul(a, b));
  };
  const Covariances<V> c = {central(4, mean.x, mean.x), central(5, mean.x, mean.y),
                            central(6, mean.x, mean.z), central(7, mean.y, mean.y),
                            central(8, mean.y, mean.z), central(9, mean.z, mean.z)};
  const V zero = hn::Zero(d);
  const V trace = c.Trace();
  const V minors = c.Minors();
  const V least = LeastEigenvalue(d, trace, minors, c.Determinant());
  const Vectors<V> normal = Normals(d, c, least);
  // of the other two eigenvalues
  const V sum = hn::Max(hn::Sub(trace, least), zero);
  const V product = hn::Max(hn::Sub(minors, hn::Mul(least, sum)), zero);
  const V half = hn::Mul(hn::Set(d, 0.5), sum);
  const V largest =
      hn::Add(half, hn::Sqrt(hn::Max(hn::Sub(hn::Mul(half, half), product), zero)));
  const V middle = hn::IfThenElseZero(hn::Gt(largest, zero), hn::Div(product, largest));
  out.Store(normal.x, d, 0);
  out.Store(normal.y, d, 1);
  out.Store(normal.z, d, 2);
  out.Store(hn::Neg(Dot(normal, mean)), d, 3);
  // The Rayleigh quotient is second order in the error of the vector.
  out.Store(hn::Max(c.Along(normal), zero), d, 4);
  out.Store(hn::Sqrt(largest), d, 5);
  out.Store(hn::Sqrt(middle), d, 6);
  out.Store(mean.x, d, 7);
  out.Store(mean.y, d, 8);
  out.Store(mean.z, d, 9);
}

template <class D>
HWY_INLINE void FillLane(const TileSums& s, std::size_t lane, Table<D, NUMBERS>& table)
{
  const std::array<double, NUMBERS> numbers = {s.n,  s.x,  s.y,  s.z,  s.xx,   s.xy,
                                               s.xz, s.yy, s.yz, s.zz, s.noise};
  for (std::size_t k = 0; k < NUMBERS; ++k)
    table.at[k][lane] = numbers[k];
}

template <class D>
HWY_INLINE void ReadLane(const Table<D, RESULTS>& table, std::size_t lane,
                         const TileSums& sums, FittedPlane& plane)
{
  plane.n = sums.n;
  if (sums.n < 3) {
    plane = FittedPlane();
    plane.n = sums.n;
    return;
  }
  // A lane of three points has been fitted with its table, which clang-tidy cannot know.
  // NOLINTNEXTLINE(clang-analyzer-core.uninitialized.UndefReturn)
  const auto number = [&](std::size_t k) { return table.at[k][lane]; };
  plane.normal = {number(0), number(1), number(2)};
  plane.d = number(3);
  plane.mse = number(4);
  plane.extent = number(5);
  plane.width = number(6);
  plane.noise = sums.noise / sums.n;
  plane.centroid = {number(7), number(8), number(9)};
  plane.orientTowardsOrigin();
}

template <class D>
HWY_INLINE void FitAll(D d, const TileSums* sums, std::size_t count,
                       FittedPlane* planes)
{
  const std::size_t lanes = hn::Lanes(d);
  Table<D, NUMBERS> in;
  Table<D, RESULTS> out;
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t used = count - i < lanes ? count - i : lanes;
    bool any = false; // in a cropped cloud whole stretches have no points
    for (std::size_t lane = 0; lane < used; ++lane) {
      FillLane(sums[i + lane], lane, in);
      any |= sums[i + lane].n >= 3;
    }
    for (std::size_t lane = used; lane < lanes; ++lane) // any numbers will do
      FillLane(sums[i], lane, in);
    if (any)
      FitTable(d, in, out);
    for (std::size_t lane = 0; lane < used; ++lane)
      ReadLane(out, lane, sums[i + lane], planes[i + lane]);
  }
}

void FitPlanes(const TileSums* sums, std::size_t count, FittedPlane* planes)
{
  // The fewer the lanes, the sooner a division is done; where there are few anyway, two of
  // these are the same.
  // NOLINTBEGIN(bugprone-branch-clone)
  if (count == 1)
    FitAll(hn::CappedTag<double, 1>(), sums, count, planes);
  else if (count <= 4)
    FitAll(hn::CappedTag<double, 4>(), sums, count, planes);
  else
    FitAll(hn::CappedTag<double, 8>(), sums, count, planes);
  // NOLINTEND(bugprone-branch-clone)
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes::adaptive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes::adaptive {

HWY_EXPORT(FitPlanes);

void fitPlanes(const TileSums* sums, std::size_t count, FittedPlane* planes)
{
  HWY_DYNAMIC_DISPATCH(FitPlanes)(sums, count, planes);
}

} // namespace pcl_mrf_planes::adaptive
#endif
