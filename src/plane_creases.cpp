// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_creases.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <utility>

namespace pcl_mrf_planes {

namespace {

/// Noise that the points of a border may have about the line, in rms distances.
constexpr double NOISE_WIDTH = 3.0;

using Pair = std::pair<std::size_t, std::size_t>;

/// Points on either side of the border of two regions, in turns: of the first, of the second.
using Borders = std::map<Pair, std::vector<Eigen::Vector3d>>;

/// Walks along rows and columns and notes where the label changes.
class BorderFinder {
public:
  BorderFinder(const OrganizedPoints& points, const std::vector<std::uint16_t>& labels,
               int reach)
  : points_(points)
  , labels_(labels)
  , reach_(reach)
  {}

  Borders find()
  {
    const int width = points_.width;
    for (int y = 0; y < points_.height; ++y)
      for (int x = 0; x < width;) {
        const int here = y * width + x;
        if (x > 0 && x + AT_ONCE <= width &&
            isNothing(labels_.data() + here, y > 0 ? width : 0)) {
          x += AT_ONCE;
          continue;
        }
        const int end = std::min(x + AT_ONCE, width);
        for (int p = here; x < end; ++x, ++p)
          if (labelAt(p) != 0) {
            look(p, 1, x);
            look(p, width, y);
          }
      }
    return std::move(borders_);
  }

private:
  static constexpr int AT_ONCE = 8;

  std::uint16_t labelAt(int index) const
  {
    return labels_[static_cast<std::size_t>(index)];
  }

  /// Whether AT_ONCE points have no plane, or one that all points to the left of and above
  /// them have as well. \param[in] above how far back those are; 0: there are none
  static bool isNothing(const std::uint16_t* labels, int above)
  {
    const std::size_t size = AT_ONCE * sizeof(std::uint16_t);
    std::uint64_t here[2];
    std::uint64_t left[2];
    std::uint64_t up[2];
    std::memcpy(here, labels, size);
    std::memcpy(left, labels - 1, size);
    std::memcpy(up, labels - above, size);
    const std::uint64_t differ = (here[0] ^ left[0]) | (here[1] ^ left[1]) |
                                 (here[0] ^ up[0]) | (here[1] ^ up[1]);
    return (here[0] | here[1]) == 0 || (differ == 0 && above > 0);
  }

  /// Notes the nearest point of a plane so many steps back at most, if it has another label.
  void look(int here, int step, int most)
  {
    most = most <= reach_ ? most : reach_ + 1;
    int last = here;
    for (int k = 0; k < most; ++k) {
      last -= step;
      if (const std::uint16_t label = labelAt(last); label != 0) {
        if (label != labelAt(here))
          note(last, here);
        return;
      }
    }
  }

  void note(int a, int b)
  {
    const std::size_t first = labels_[static_cast<std::size_t>(a)] - 1U;
    const std::size_t second = labels_[static_cast<std::size_t>(b)] - 1U;
    const Pair pair = std::minmax(first, second);
    if (border_ == nullptr || pair != pair_) { // most often the one from before
      pair_ = pair;
      border_ = &borders_[pair];
    }
    const bool in_order = first < second;
    border_->push_back(point(in_order ? a : b));
    border_->push_back(point(in_order ? b : a));
  }

  Eigen::Vector3d point(int index) const
  {
    const auto i = static_cast<std::size_t>(index);
    return {points_.x[i], points_.y[i], points_.z[i]};
  }

  const OrganizedPoints& points_;
  const std::vector<std::uint16_t>& labels_;
  int reach_;
  Borders borders_;
  Pair pair_; ///< that was noted last
  std::vector<Eigen::Vector3d>* border_ = nullptr;
};

/// A point of the border that lies on the line.
struct CreasePoint {
  double place = 0.0; ///< along the line, metres
  double bulge = 0.0; ///< see bulgeOf()
  bool operator<(const CreasePoint& other) const { return place < other.place; }
};

struct Piece {
  double start = 0.0;
  double end = 0.0;
  double bulge = 0.0; ///< sum of its points
  int points = 0;
};

/// How far the ray through \a p meets \a plane in front of \a other, metres.
double heightAt(const Eigen::Vector3d& p, const Plane& plane, const Plane& other)
{
  return other.distance(-plane.d / plane.normal.dot(p) * p);
}

/// Positive where two neighbours across a border are on an edge that bulges towards the
/// sensor: away from it each plane goes behind the other one. Between two rays that is a
/// matter of the planes alone; noise of the points and of the border's place drop out.
double bulgeOf(const Eigen::Vector3d& in_a, const Eigen::Vector3d& in_b, const Plane& a,
               const Plane& b)
{
  const double bulge = heightAt(in_b, a, b) - heightAt(in_a, a, b) +
                       heightAt(in_a, b, a) - heightAt(in_b, b, a);
  return std::isfinite(bulge) ? bulge : 0.0;
}

/// Cuts what lies on a line where nothing does for too long.
std::vector<Piece> piecesOf(std::vector<CreasePoint>& points,
                            const CreaseParameters& parameters)
{
  std::sort(points.begin(), points.end());
  std::vector<Piece> pieces;
  for (std::size_t begin = 0; begin < points.size();) {
    Piece piece;
    piece.start = points[begin].place;
    std::size_t end = begin;
    do {
      piece.bulge += points[end].bulge;
      piece.end = points[end].place;
      ++end;
    } while (end < points.size() &&
             points[end].place - piece.end <= parameters.max_gap);
    piece.points = static_cast<int>(end - begin);
    if (piece.points >= parameters.min_points)
      pieces.push_back(piece);
    begin = end;
  }
  return pieces;
}

void addCreases(const std::vector<PlaneRegion>& regions, const Pair& pair,
                const std::vector<Eigen::Vector3d>& border,
                const CreaseParameters& parameters, std::vector<PlaneCrease>& creases)
{
  const PlaneRegion& a = regions[pair.first];
  const PlaneRegion& b = regions[pair.second];
  PlaneCrease crease;
  crease.first = pair.first;
  crease.second = pair.second;
  crease.angle = normalAngle(a.plane, b.plane);
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
  if (std::min(crease.angle, M_PI - crease.angle) < parameters.min_angle ||
      !intersectPlanes(a.plane, b.plane, border.front(), origin, direction))
    return;
  const double tolerance =
      std::max(parameters.tolerance, NOISE_WIDTH * std::max(a.rms, b.rms));
  std::vector<CreasePoint> points;
  for (std::size_t k = 0; k < border.size(); ++k) {
    const Eigen::Vector3d& p = border[k];
    const double place = direction.dot(p - origin);
    if ((p - origin - place * direction).norm() <= tolerance)
      points.push_back({place, bulgeOf(border[k & ~std::size_t{1}], border[k | 1U],
                                       a.plane, b.plane)});
  }
  for (const Piece& piece : piecesOf(points, parameters)) {
    crease.start = origin + piece.start * direction;
    crease.end = origin + piece.end * direction;
    crease.points = piece.points;
    crease.convex = piece.bulge > 0.0;
    creases.push_back(crease);
  }
}

} // namespace

std::string CreaseParameters::validate() const
{
  // Written so that NaN fails.
  if (!(min_angle >= 0.0 && min_angle <= M_PI / 2))
    return "the least angle of creases must be 0 to 90 degrees";
  if (!(tolerance > 0.0) || !(max_gap > 0.0))
    return "tolerance and gap of creases must be more than 0 metres";
  if (reach < 0 || min_points < 1)
    return "creases reach over 0 points or more, and need 1 point or more";
  return {};
}

std::vector<PlaneCrease> findCreases(const OrganizedPoints& points,
                                     const std::vector<PlaneRegion>& regions,
                                     const CreaseParameters& parameters)
{
  const std::vector<std::uint16_t> labels = regionLabels(points, regions);
  const Borders borders = BorderFinder(points, labels, parameters.reach).find();
  std::vector<PlaneCrease> creases;
  for (const auto& [pair, border] : borders)
    addCreases(regions, pair, border, parameters, creases);
  return creases;
}

PlaneCrease inCloudFrame(const PlaneCrease& crease, const SensorPose& pose)
{
  PlaneCrease out = crease;
  out.start = pose.rotation * crease.start + pose.origin;
  out.end = pose.rotation * crease.end + pose.origin;
  return out;
}

double normalAngle(const Plane& a, const Plane& b)
{
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

double planeDistance(const PlaneRegion& a, const PlaneRegion& b)
{
  return (std::abs(a.plane.distance(b.centroid)) +
          std::abs(b.plane.distance(a.centroid))) /
         2.0;
}

bool intersectPlanes(const Plane& a, const Plane& b, const Eigen::Vector3d& near,
                     Eigen::Vector3d& point, Eigen::Vector3d& direction)
{
  constexpr double PARALLEL = 1e-6;
  const Eigen::Vector3d across = a.normal.cross(b.normal);
  const double sine = across.norm();
  if (!(sine > PARALLEL))
    return false;
  direction = across / sine;
  // near + s n_a + t n_b on both planes.
  const double cosine = a.normal.dot(b.normal);
  const double da = a.distance(near);
  const double db = b.distance(near);
  const double squared_sine = sine * sine;
  point = near - (da - cosine * db) / squared_sine * a.normal -
          (db - cosine * da) / squared_sine * b.normal;
  return true;
}

} // namespace pcl_mrf_planes
