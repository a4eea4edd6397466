// SPDX-License-Identifier: BSD-3-Clause
//
// Distances of corners from a segment. Compiled once for every instruction set that the
// compiler knows; the best one is chosen at run time. Products and sums are not fused, and
// the first of the farthest counts: all of them give the same corners.
#include "line_simplification.h"

#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "line_simplification.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef PCL_MRF_PLANES_FARTHEST_CORNER
#define PCL_MRF_PLANES_FARTHEST_CORNER
namespace pcl_mrf_planes {

struct FarthestCorner {
  double squared = -1.0; ///< distance
  double index = 0.0;
};

} // namespace pcl_mrf_planes
#endif

HWY_BEFORE_NAMESPACE();
namespace pcl_mrf_planes {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Squared distances from the segment between two corners.
template <class D>
class SegmentDistance {
public:
  using V = hn::Vec<D>;

  SegmentDistance(const double* x, const double* y, std::size_t first, std::size_t last)
  : x_(x)
  , y_(y)
  , x1_(hn::Set(D(), x[first]))
  , y1_(hn::Set(D(), y[first]))
  , x2_(hn::Set(D(), x[last]))
  , y2_(hn::Set(D(), y[last]))
  , vx_(hn::Sub(x2_, x1_))
  , vy_(hn::Sub(y2_, y1_))
  , length_(hn::Add(hn::Mul(vx_, vx_), hn::Mul(vy_, vy_)))
  {}

  HWY_INLINE V at(std::size_t k) const
  {
    const D d;
    const V px = hn::LoadU(d, x_ + k);
    const V py = hn::LoadU(d, y_ + k);
    const V along =
        hn::Add(hn::Mul(hn::Sub(px, x1_), vx_), hn::Mul(hn::Sub(py, y1_), vy_));
    const V share = hn::Div(along, length_);
    const auto before = hn::Le(along, hn::Zero(d));
    const auto behind = hn::Le(length_, along);
    V qx = hn::IfThenElse(behind, x2_, hn::Add(x1_, hn::Mul(vx_, share)));
    V qy = hn::IfThenElse(behind, y2_, hn::Add(y1_, hn::Mul(vy_, share)));
    qx = hn::IfThenElse(before, x1_, qx);
    qy = hn::IfThenElse(before, y1_, qy);
    const V dx = hn::Sub(px, qx);
    const V dy = hn::Sub(py, qy);
    return hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
  }

private:
  const double* x_;
  const double* y_;
  V x1_, y1_, x2_, y2_, vx_, vy_, length_;
};

/// Looks at whole vectors of corners from k on, up to the last one; returns where it ended.
template <class D>
HWY_INLINE std::size_t Look(D d, const double* x, const double* y, std::size_t first,
                            std::size_t last, std::size_t k, FarthestCorner& best)
{
  const SegmentDistance<D> distance(x, y, first, last);
  const std::size_t lanes = hn::Lanes(d);
  auto most = hn::Set(d, -1.0);
  auto where = hn::Zero(d);
  auto here = hn::Iota(d, static_cast<double>(k));
  for (; k + lanes <= last; k += lanes) {
    const auto squared = distance.at(k);
    const auto more = hn::Gt(squared, most);
    most = hn::IfThenElse(more, squared, most);
    where = hn::IfThenElse(more, here, where);
    here = hn::Add(here, hn::Set(d, static_cast<double>(lanes)));
  }
  double squares[hn::MaxLanes(d)];
  double indices[hn::MaxLanes(d)];
  hn::StoreU(most, d, squares);
  hn::StoreU(where, d, indices);
  for (std::size_t l = 0; l < lanes; ++l)
    if (squares[l] > best.squared ||
        (squares[l] == best.squared && indices[l] < best.index))
      best = {squares[l], indices[l]};
  return k;
}

void FindFarthest(const double* x, const double* y, std::size_t first, std::size_t last,
                  FarthestCorner& best)
{
  const hn::ScalableTag<double> d;
  const hn::CappedTag<double, 1> one;
  std::size_t k = first + 1;
  if (k + hn::Lanes(d) <= last)
    k = Look(d, x, y, first, last, k, best);
  Look(one, x, y, first, last, k, best);
}

} // namespace HWY_NAMESPACE
} // namespace pcl_mrf_planes
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pcl_mrf_planes {

HWY_EXPORT(FindFarthest);

void keepCorners(const FlatLine& line, std::size_t first, std::size_t last,
                 double tolerance, std::vector<std::uint8_t>& kept)
{
  kept[first] = kept[last] = 1;
  std::vector<std::pair<std::size_t, std::size_t>> left = {{first, last}};
  while (!left.empty()) {
    const auto [begin, end] = left.back();
    left.pop_back();
    if (end < begin + 2)
      continue;
    FarthestCorner best;
    HWY_DYNAMIC_DISPATCH(FindFarthest)(line.x.data(), line.y.data(), begin, end, best);
    if (!(best.squared > tolerance * tolerance))
      continue;
    const auto corner = static_cast<std::size_t>(best.index);
    kept[corner] = 1;
    left.emplace_back(begin, corner);
    left.emplace_back(corner, end);
  }
}

} // namespace pcl_mrf_planes
#endif
