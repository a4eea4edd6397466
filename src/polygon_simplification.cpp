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
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

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
    const Eigen::Vector2d& b = k + 1 < ring.size() ? ring[k + 1] : ring[0];
    sum += a.x() * b.y() - a.y() * b.x();
  }
  return sum;
}

std::size_t farthest(const FlatRing& ring, const Eigen::Vector2d& from)
{
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (const double squared = (ring[k] - from).squaredNorm(); squared > most) {
      most = squared;
      best = k;
    }
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
        out.emplace_back(line.x[k], line.y[k]);
    // Nothing is left of a piece that ends where it began.
    if (out.size() == before + 1 && bg::equals(Point(line.x[begin], line.y[begin]),
                                               Point(line.x[end], line.y[end])))
      out.pop_back();
  }
  return out;
}

/// An octagon inside the convex hull, none of whose corners lies inside it (Akl and
/// Toussaint, 1978).
class Octagon {
public:
  /// \param[in] corners one or more
  explicit Octagon(const FlatRing& corners)
  {
    constexpr double ROUNDING = 1e-9; // of the squared size
    const std::array<std::size_t, EIGHT> farthest = farthestCorners(corners);
    double size = 0;
    for (std::size_t k = 0; k < EIGHT; ++k) {
      corners_[k] = corners[farthest[k]];
      size = std::max(size, (corners_[k] - corners_[0]).squaredNorm());
    }
    for (std::size_t k = 0; k < EIGHT; ++k)
      if (const Eigen::Vector2d edge = corners_[(k + 1) % EIGHT] - corners_[k];
          edge.squaredNorm() > 0) {
        corners_[edges_] = corners_[k];
        ways_[edges_++] = edge;
      }
    least_ = ROUNDING * size;
  }

  bool isInside(const Eigen::Vector2d& p) const
  {
    for (std::size_t k = 0; k < edges_; ++k) {
      const Eigen::Vector2d way = p - corners_[k];
      if (!(ways_[k].x() * way.y() - ways_[k].y() * way.x() > least_))
        return false;
    }
    return edges_ > 2;
  }

private:
  static constexpr std::size_t EIGHT = 8;

  /// Farthest to the right, to the upper right, and so on.
  static std::array<std::size_t, EIGHT> farthestCorners(const FlatRing& corners)
  {
    std::array<std::size_t, EIGHT> best = {};
    std::array<double, EIGHT> most;
    most.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const double x = corners[k].x();
      const double y = corners[k].y();
      const double along[] = {x, x + y, y, y - x, -x, -x - y, -y, x - y};
      for (std::size_t d = 0; d < EIGHT; ++d)
        if (along[d] > most[d]) {
          most[d] = along[d];
          best[d] = k;
        }
    }
    return best;
  }

  std::array<Eigen::Vector2d, EIGHT> corners_;
  std::array<Eigen::Vector2d, EIGHT> ways_; ///< to the next corner
  std::size_t edges_ = 0;
  double least_ = 0;
};

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
  const Octagon octagon(corners);
  for (const Eigen::Vector2d& corner : corners)
    if (!octagon.isInside(corner)) // else no corner of the hull
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
