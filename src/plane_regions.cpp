// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_regions.h>

#include <pcl_mrf_planes/scatter_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

namespace pcl_mrf_planes {

namespace {

/// What is gathered of one label on the way through the image.
struct RegionSums {
  std::vector<int> indices;
  ScatterMatrix scatter;
  double area = 0.0;
};

Eigen::Vector3d pointAt(const OrganizedPoints& points, std::size_t i)
{
  return {points.x[i], points.y[i], points.z[i]};
}

/// Adds the points of a row to the sums of their labels, run by run.
void addRow(const OrganizedPoints& points, const std::vector<std::uint16_t>& labels,
            std::size_t start, std::size_t end, std::vector<RegionSums>& sums)
{
  for (std::size_t i = start; i < end;) {
    if (points.valid[i] == 0 || labels[i] == NO_PLANE) {
      ++i;
      continue;
    }
    const std::uint16_t label = labels[i];
    ScatterMatrix run;
    std::vector<int>& indices = sums[label].indices;
    for (; i < end && points.valid[i] != 0 && labels[i] == label; ++i) {
      run.add(points.x[i], points.y[i], points.z[i]);
      indices.push_back(static_cast<int>(i));
    }
    sums[label].scatter += run;
  }
}

/// Area of the surface between four neighbouring points, or three of them, in the plane
/// of their label. The component of the cross product along the normal has a sign, so
/// that noise cancels between neighbouring squares.
///
/// a b
/// c d
void addSquare(const OrganizedPoints& points, const std::vector<Plane>& planes,
               const std::vector<std::uint16_t>& labels, std::size_t a,
               std::vector<RegionSums>& sums)
{
  const std::size_t b = a + 1;
  const std::size_t c = a + static_cast<std::size_t>(points.width);
  const std::size_t d = c + 1;
  const auto joined = [&](std::size_t i, std::size_t j) {
    return points.valid[i] != 0 && points.valid[j] != 0 && labels[i] == labels[j] &&
           labels[i] != NO_PLANE;
  };
  const bool ab = joined(a, b);
  const bool cd = joined(c, d);
  const bool ac = joined(a, c);
  const bool bd = joined(b, d);
  const auto edge = [&](std::size_t from, std::size_t to) {
    return Eigen::Vector3d(pointAt(points, to) - pointAt(points, from));
  };
  const auto add = [&](std::size_t corner, const Eigen::Vector3d& u,
                       const Eigen::Vector3d& v) {
    const std::uint16_t label = labels[corner];
    sums[label].area += 0.5 * planes[label].normal.dot(u.cross(v));
  };
  if (ab && cd && ac)
    add(a, edge(a, d), edge(b, c)); // the diagonals give the whole square
  else if (ab && ac)
    add(a, edge(a, b), edge(a, c));
  else if (ab && bd)
    add(b, edge(b, d), edge(b, a));
  else if (cd && ac)
    add(c, edge(c, a), edge(c, d));
  else if (cd && bd)
    add(d, edge(d, c), edge(d, b));
}

PlaneRegion makeRegion(const Plane& plane, std::size_t label, RegionSums&& sums)
{
  PlaneRegion region;
  region.plane = plane;
  region.label = static_cast<int>(label);
  region.indices = std::move(sums.indices);
  region.area = std::abs(sums.area);
  region.rms = sums.scatter.rmsDistance(plane);
  region.centroid = sums.scatter.centroid();
  region.covariance = sums.scatter.covariance();
  return region;
}

/// Largest area first; then most points; then the first point.
auto rank(const PlaneRegion& region)
{
  return std::make_tuple(-region.area, -static_cast<double>(region.indices.size()),
                         region.indices.front());
}

} // namespace

std::vector<PlaneRegion> gatherRegions(const OrganizedPoints& points,
                                       const std::vector<Plane>& planes,
                                       const std::vector<std::uint16_t>& labels,
                                       int min_points)
{
  std::vector<RegionSums> sums(planes.size());
  const auto width = static_cast<std::size_t>(points.width);
  for (std::size_t row = 0; row < points.size(); row += width) {
    addRow(points, labels, row, row + width, sums);
    if (row + width < points.size())
      for (std::size_t i = row; i + 1 < row + width; ++i)
        addSquare(points, planes, labels, i, sums);
  }

  std::vector<PlaneRegion> regions;
  for (std::size_t l = 0; l < planes.size(); ++l)
    if (!sums[l].indices.empty() &&
        sums[l].indices.size() >= static_cast<std::size_t>(min_points))
      regions.push_back(makeRegion(planes[l], l, std::move(sums[l])));
  std::sort(
      regions.begin(), regions.end(),
      [](const PlaneRegion& p, const PlaneRegion& q) { return rank(p) < rank(q); });
  return regions;
}

std::vector<std::uint16_t> regionLabels(const OrganizedPoints& points,
                                        const std::vector<PlaneRegion>& regions)
{
  std::vector<std::uint16_t> image(points.size(), 0);
  for (std::size_t k = 0; k < regions.size(); ++k)
    for (const int i : regions[k].indices)
      image[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(k + 1);
  return image;
}

} // namespace pcl_mrf_planes
