// SPDX-License-Identifier: BSD-3-Clause
//
// Points onto their plane. Compiled once for every instruction set that the compiler knows;
// the best one is chosen at run time. Lanes do not depend on one another, and products and
// sums are not fused: all of them give the same bits.
#include "plane_projection_kernel.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "plane_projection_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// Has to come after foreach_target.h.
#include "vector_loops-inl.h"

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t AT_ONCE = 64;

/// Coordinates of some points, each by itself.
struct Batch {
  float x[AT_ONCE], y[AT_ONCE], z[AT_ONCE];
};

template <class D>
HWY_INLINE void ProjectLanes(D d, const ProjectionTarget& target, std::size_t i,
                             Batch& batch)
{
  using V = hn::Vec<D>;
  const hn::Rebind<float, D> f;
  const V ox = hn::Set(d, target.origin[0]);
  const V oy = hn::Set(d, target.origin[1]);
  const V oz = hn::Set(d, target.origin[2]);
  const V nx = hn::Set(d, target.normal[0]);
  const V ny = hn::Set(d, target.normal[1]);
  const V nz = hn::Set(d, target.normal[2]);
  const PointLanes<V> p = LoadPoints(d, batch.x, batch.y, batch.z, i);
  const V x = hn::Sub(p.x, ox);
  const V y = hn::Sub(p.y, oy);
  const V z = hn::Sub(p.z, oz);
  const V facing = hn::Add(hn::Mul(nx, x), hn::Add(hn::Mul(ny, y), hn::Mul(nz, z)));
  const V squared = hn::Add(hn::Mul(x, x), hn::Add(hn::Mul(y, y), hn::Mul(z, z)));
  const V least = hn::Mul(hn::Set(d, target.grazing), hn::Sqrt(squared));
  const V factor = hn::Div(hn::Set(d, -target.d), facing);
  const auto along_ray =
      hn::And(hn::Gt(hn::Abs(facing), least), hn::Gt(factor, hn::Zero(d)));
  const V distance = hn::Add(facing, hn::Set(d, target.d));
  const auto moved = [&](V at, V n, V o) HWY_ATTR {
    const V q = hn::IfThenElse(along_ray, hn::Mul(factor, at),
                               hn::Sub(at, hn::Mul(distance, n)));
    return hn::DemoteTo(f, hn::Add(q, o));
  };
  hn::StoreU(moved(x, nx, ox), f, batch.x + i);
  hn::StoreU(moved(y, ny, oy), f, batch.y + i);
  hn::StoreU(moved(z, nz, oz), f, batch.z + i);
}

void ProjectPoints(const ProjectionTarget& target, const int* indices,
                   std::size_t count, std::size_t stride, float* first)
{
  const hn::CappedTag<double, AT_ONCE> d;
  Batch batch = {};
  for (std::size_t begin = 0; begin < count; begin += AT_ONCE) {
    const std::size_t points = std::min(AT_ONCE, count - begin);
    const auto point = [&](std::size_t i) {
      return first + static_cast<std::size_t>(indices[begin + i]) * stride;
    };
    for (std::size_t i = 0; i < points; ++i) {
      const float* p = point(i);
      batch.x[i] = p[0];
      batch.y[i] = p[1];
      batch.z[i] = p[2];
    }
    // The last vector may hold points from before: they are not written back.
    for (std::size_t i = 0; i < points; i += hn::Lanes(d))
      ProjectLanes(d, target, i, batch);
    for (std::size_t i = 0; i < points; ++i) {
      float* p = point(i);
      p[0] = batch.x[i];
      p[1] = batch.y[i];
      p[2] = batch.z[i];
    }
  }
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(ProjectPoints);

void projectPoints(const ProjectionTarget& target, const int* indices,
                   std::size_t count, std::size_t stride, float* first)
{
  HWY_DYNAMIC_DISPATCH(ProjectPoints)(target, indices, count, stride, first);
}

} // namespace pcl_mrf_planes
#endif
