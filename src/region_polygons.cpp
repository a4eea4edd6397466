// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/region_polygons.h>

#include "corner_rays.h"
#include "label_runs.h"
#include "pixel_rings.h"
#include "polygon_simplification.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pcl_mrf_planes {

namespace {

/// A plane with two axes; counterclockwise as the sensor sees it.
struct PlaneAxes {
  explicit PlaneAxes(const PlaneRegion& region)
  : plane(region.plane)
  , origin(region.centroid - region.plane.distance(region.centroid) * plane.normal)
  , right(plane.normal.unitOrthogonal())
  , up(plane.normal.cross(right))
  {}

  Eigen::Vector2d flat(const Eigen::Vector3d& point) const
  {
    return {right.dot(point - origin), up.dot(point - origin)};
  }
  PlaneRing raised(const FlatRing& ring) const
  {
    PlaneRing out;
    out.reserve(ring.size());
    for (const Eigen::Vector2d& corner : ring)
      out.emplace_back(origin + corner.x() * right + corner.y() * up);
    return out;
  }

  Plane plane;
  Eigen::Vector3d origin;
  Eigen::Vector3d right;
  Eigen::Vector3d up;
};

/// Where the ray through a corner meets the plane. A ray that would meet it far beyond the
/// pixel of the patch beside it, near the horizon, is replaced by that pixel's; it ends
/// at four times the depth of the point where that is none of the plane, as profile PAPER has
/// them.
Eigen::Vector2d project(const CornerRays& rays, const PlaneAxes& axes,
                        const PixelCorner& corner)
{
  constexpr double HORIZON = 0.25;
  constexpr double FARTHEST = 4.0; // over the point's own depth
  const Eigen::Vector3d& normal = axes.plane.normal;
  const Eigen::Vector3d beside = rays.pixelRay(corner.pixel);
  Eigen::Vector3d ray = rays.cornerRay(corner.x, corner.y);
  if (!(normal.dot(ray) < HORIZON * std::min(normal.dot(beside), 0.0)))
    ray = beside;
  const double facing = std::min(normal.dot(ray), -1e-9);
  const double depth = std::min(-axes.plane.d / facing,
                                FARTHEST * std::abs(rays.pixelDepth(corner.pixel)));
  return axes.flat(depth * ray);
}

/// Rings on the plane, and their corners that other rings meet.
void flatten(const PixelRings& rings, const CornerRays& rays, const PlaneAxes& axes,
             FlatPolygon& polygon, FixedCorners& fixed)
{
  for (const std::vector<PixelCorner>& ring : rings) {
    FlatRing flat;
    std::vector<std::uint8_t> touched;
    flat.reserve(ring.size());
    for (const PixelCorner& corner : ring) {
      flat.push_back(project(rays, axes, corner));
      touched.push_back(corner.touched ? 1 : 0);
    }
    polygon.push_back(std::move(flat));
    fixed.push_back(std::move(touched));
  }
}

class Outliner {
public:
  Outliner(const OrganizedPoints& points, const std::vector<PlaneRegion>& regions,
           const OutlineParameters& parameters)
  : parameters_(parameters)
  , image_(regionRuns(regions, points.width, points.height))
  , parts_(connectRuns(image_))
  , rings_(tracePixelRings(image_, parts_))
  , rays_(points)
  , parts_of_region_(regions.size())
  {
    for (std::size_t k = 0; k < parts_.label.size(); ++k)
      parts_of_region_[parts_.label[k] - 1U].push_back(k);
    for (std::vector<std::size_t>& parts : parts_of_region_)
      std::stable_sort(parts.begin(), parts.end(), [&](std::size_t a, std::size_t b) {
        return parts_.size[a] > parts_.size[b];
      });
  }

  RegionOutline outline(const PlaneRegion& region, std::size_t index) const
  {
    const PlaneAxes axes(region);
    RegionOutline out;
    FlatRing all;
    for (const std::size_t part : parts_of_region_[index]) {
      FlatPolygon polygon;
      FixedCorners fixed;
      flatten(rings_[part], rays_, axes, polygon, fixed);
      const FlatRing border = polygon.front();
      if (add(part, axes, std::move(polygon), fixed, out))
        all.insert(all.end(), border.begin(), border.end());
    }
    if (!all.empty())
      out.hull = axes.raised(convexHull(all));
    return out;
  }

private:
  /// \return whether the patch is large enough
  bool add(std::size_t part, const PlaneAxes& axes, FlatPolygon polygon,
           const FixedCorners& fixed, RegionOutline& out) const
  {
    if (parts_.size[part] < parameters_.min_points)
      return false;
    polygon = simplifyPolygon(std::move(polygon), fixed, parameters_.tolerance,
                              parameters_.min_hole_area);
    if (polygon.empty())
      return false;
    PlanePolygon patch;
    patch.area = polygonArea(polygon);
    if (patch.area < parameters_.min_area)
      return false;
    patch.points = parts_.size[part];
    patch.outer = axes.raised(polygon.front());
    for (std::size_t k = 1; k < polygon.size(); ++k)
      patch.holes.push_back(axes.raised(polygon[k]));
    out.patches.push_back(std::move(patch));
    return true;
  }

  const OutlineParameters& parameters_;
  LabelRuns image_;
  RunParts parts_;
  std::vector<PixelRings> rings_;
  CornerRays rays_;
  std::vector<std::vector<std::size_t>> parts_of_region_; ///< largest first
};

} // namespace

std::string OutlineParameters::validate() const
{
  // Written so that NaN fails.
  if (!(tolerance >= 0.0))
    return "the tolerance of outlines must be 0 metres or more";
  if (min_points < 0)
    return "the fewest points of a patch must be 0 or more";
  if (!(min_area >= 0.0) || !(min_hole_area >= 0.0))
    return "the least areas of patches and holes must be 0 square metres or more";
  return {};
}

RegionOutline inCloudFrame(const RegionOutline& outline, const SensorPose& pose)
{
  const auto move = [&](PlaneRing& ring) {
    for (Eigen::Vector3d& corner : ring)
      corner = pose.rotation * corner + pose.origin;
  };
  RegionOutline out = outline;
  move(out.hull);
  for (PlanePolygon& patch : out.patches) {
    move(patch.outer);
    for (PlaneRing& hole : patch.holes)
      move(hole);
  }
  return out;
}

std::vector<RegionOutline> outlineRegions(const OrganizedPoints& points,
                                          const std::vector<PlaneRegion>& regions,
                                          const OutlineParameters& parameters)
{
  if (regions.empty())
    return {};
  const Outliner outliner(points, regions, parameters);
  std::vector<RegionOutline> outlines;
  outlines.reserve(regions.size());
  for (std::size_t k = 0; k < regions.size(); ++k)
    outlines.push_back(outliner.outline(regions[k], k));
  return outlines;
}

} // namespace pcl_mrf_planes
