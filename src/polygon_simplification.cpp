// SPDX-License-Identifier: BSD-3-Clause
#include "polygon_simplification.h"

#include "line_simplification.h"

// Coordinates stay as they are, as newer versions of Boost have it.
#define BOOST_GEOMETRY_NO_ROBUSTNESS
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false>; // counterclockwise, closed

Polygon toBoost(const FlatPolygon& polygon)
{
  Polygon out;
  const auto fill = [](const FlatRing& ring, auto& to) {
    for (const Eigen::Vector2d& corner : ring)
      to.emplace_back(corner.x(), corner.y());
    if (!ring.empty())
      to.push_back(to.front());
  };
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (k == 0)
      fill(polygon[k], out.outer());
    else
      fill(polygon[k], out.inners().emplace_back());
  return out;
}

double twiceArea(const FlatRing& ring)
{
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Eigen::Vector2d& a = ring[k];
    const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::size_t farthest(const FlatRing& ring, const Eigen::Vector2d& from)
{
  std::size_t best = 0;
  for (std::size_t k = 1; k < ring.size(); ++k)
    if ((ring[k] - from).squaredNorm() > (ring[best] - from).squaredNorm())
      best = k;
  return best;
}

Eigen::Vector2d middleOf(const FlatRing& ring)
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : ring)
    sum += corner;
  return sum / static_cast<double>(ring.size());
}

/// Corners from which and to which the border is simplified piece by piece.
std::vector<std::size_t> anchorsOf(const FlatRing& ring,
                                   const std::vector<std::uint8_t>& fixed)
{
  std::vector<std::size_t> anchors;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (fixed[k] != 0)
      anchors.push_back(k);
  if (anchors.size() < 2) { // corners that are in no danger
    const std::size_t first = farthest(ring, middleOf(ring));
    anchors.insert(anchors.end(), {first, farthest(ring, ring[first])});
    std::sort(anchors.begin(), anchors.end());
    anchors.erase(std::unique(anchors.begin(), anchors.end()), anchors.end());
  }
  return anchors;
}

/// The corners of a ring, and once more those up to the first anchor.
FlatLine unrolled(const FlatRing& ring, std::size_t first_anchor)
{
  FlatLine line;
  line.x.reserve(ring.size() + first_anchor + 1);
  line.y.reserve(ring.size() + first_anchor + 1);
  const auto add = [&](const Eigen::Vector2d& corner) {
    line.x.push_back(corner.x());
    line.y.push_back(corner.y());
  };
  for (const Eigen::Vector2d& corner : ring)
    add(corner);
  for (std::size_t k = 0; k <= first_anchor; ++k)
    add(ring[k]);
  return line;
}

FlatRing simplifyRing(const FlatRing& ring, const std::vector<std::uint8_t>& fixed,
                      double tolerance)
{
  const std::vector<std::size_t> anchors = anchorsOf(ring, fixed);
  const FlatLine line = unrolled(ring, anchors[0]);
  std::vector<std::uint8_t> kept(line.x.size());
  FlatRing out;
  for (std::size_t a = 0; a < anchors.size(); ++a) {
    const std::size_t begin = anchors[a];
    const std::size_t end =
        a + 1 < anchors.size() ? anchors[a + 1] : anchors[0] + ring.size();
    keepCorners(line, begin, end, tolerance, kept);
    const std::size_t before = out.size();
    for (std::size_t k = begin; k < end; ++k)
      if (kept[k] != 0)
        out.push_back(ring[k % ring.size()]);
    // Nothing is left of a piece that ends where it began.
    if (out.size() == before + 1 && bg::equals(Point(line.x[begin], line.y[begin]),
                                               Point(line.x[end], line.y[end])))
      out.pop_back();
  }
  return out;
}

/// The corners farthest along eight directions, counterclockwise: an octagon whose inside
/// has no corner of the hull (Akl and Toussaint, 1978).
FlatRing farthestCorners(const FlatRing& corners)
{
  const Eigen::Vector2d directions[] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                        {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
  FlatRing out;
  for (const Eigen::Vector2d& direction : directions) {
    std::size_t best = 0;
    double most = direction.dot(corners[0]);
    for (std::size_t k = 1; k < corners.size(); ++k)
      if (const double along = direction.dot(corners[k]); along > most) {
        most = along;
        best = k;
      }
    if (out.empty() || (corners[best] != out.back() && corners[best] != out.front()))
      out.push_back(corners[best]);
  }
  return out;
}

/// Without the corners that lie well inside the convex hull.
FlatRing outermost(const FlatRing& corners)
{
  constexpr double ROUNDING = 1e-9; // of the squared size
  const FlatRing octagon = farthestCorners(corners);
  double size = 0;
  for (const Eigen::Vector2d& corner : octagon)
    size = std::max(size, (corner - octagon[0]).squaredNorm());
  const double least = ROUNDING * size;
  const auto isInside = [&](const Eigen::Vector2d& p) {
    for (std::size_t k = 0; k < octagon.size(); ++k) {
      const Eigen::Vector2d& a = octagon[k];
      const Eigen::Vector2d edge = octagon[(k + 1) % octagon.size()] - a;
      const Eigen::Vector2d way = p - a;
      if (!(edge.x() * way.y() - edge.y() * way.x() > least))
        return false;
    }
    return true;
  };
  FlatRing out;
  for (const Eigen::Vector2d& corner : corners)
    if (!isInside(corner))
      out.push_back(corner);
  return out;
}

/// Turns the rings as they should be, and drops holes that are too small.
void arrange(FlatPolygon& polygon, FixedCorners& fixed, double min_hole_area)
{
  std::size_t kept = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const double area = twiceArea(polygon[k]) / 2;
    if (k > 0 && std::abs(area) < min_hole_area)
      continue;
    if ((area > 0) != (k == 0)) {
      std::reverse(polygon[k].begin(), polygon[k].end());
      std::reverse(fixed[k].begin(), fixed[k].end());
    }
    if (kept != k) {
      polygon[kept] = std::move(polygon[k]);
      fixed[kept] = std::move(fixed[k]);
    }
    ++kept;
  }
  polygon.resize(kept);
  fixed.resize(kept);
}

} // namespace

FlatPolygon simplifyPolygon(FlatPolygon polygon, const FixedCorners& fixed_corners,
                            double tolerance, double min_hole_area)
{
  constexpr int HALVINGS = 8;
  FixedCorners fixed = fixed_corners;
  arrange(polygon, fixed, min_hole_area);
  for (int k = 0; k <= HALVINGS; ++k, tolerance = k < HALVINGS ? tolerance / 2 : 0.0) {
    FlatPolygon simple;
    for (std::size_t r = 0; r < polygon.size(); ++r)
      simple.push_back(simplifyRing(polygon[r], fixed[r], tolerance));
    if (isValidPolygon(simple))
      return simple;
  }
  FlatPolygon hull = {convexHull(polygon.front())};
  return isValidPolygon(hull) ? hull : FlatPolygon();
}

FlatRing convexHull(const FlatRing& corners)
{
  if (corners.empty())
    return {};
  bg::model::multi_point<Point> all;
  for (const Eigen::Vector2d& corner : outermost(corners))
    all.emplace_back(corner.x(), corner.y());
  Polygon hull;
  bg::convex_hull(all, hull);
  FlatRing out;
  for (std::size_t k = 0; k + 1 < hull.outer().size(); ++k)
    out.emplace_back(hull.outer()[k].x(), hull.outer()[k].y());
  return out;
}

double polygonArea(const FlatPolygon& polygon)
{
  return bg::area(toBoost(polygon));
}

bool isValidPolygon(const FlatPolygon& polygon)
{
  return !polygon.empty() && bg::is_valid(toBoost(polygon));
}

} // namespace pcl_mrf_planes
