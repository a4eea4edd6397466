// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/plane_regions.h>

#include <pcl_mrf_planes/scatter_matrix.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace pcl_mrf_planes {

namespace {

Eigen::Vector3d pointAt(const OrganizedPoints& points, std::size_t i)
{
  return {points.x[i], points.y[i], points.z[i]};
}

/// Adds the area of the square of points whose upper left corner is \a i to the label
/// that at least three of its corners share. The cross product's component along the
/// normal is signed, so that noise cancels between neighbouring squares.
void addSquare(const OrganizedPoints& points, const std::vector<Plane>& planes,
               const std::vector<std::uint16_t>& labels, std::size_t i,
               std::vector<double>& areas)
{
  const auto width = static_cast<std::size_t>(points.width);
  const std::size_t corners[4] = {i, i + 1, i + width + 1, i + width}; // around
  for (int skipped = -1; skipped < 4; ++skipped) {
    // All four corners first, then each triangle.
    std::size_t ring[4];
    int count = 0;
    for (int k = 0; k < 4; ++k)
      if (k != skipped)
        ring[count++] = corners[k];
    const std::uint16_t label = labels[ring[0]];
    const bool one_label = std::all_of(ring, ring + count, [&](std::size_t corner) {
      return points.valid[corner] != 0 && labels[corner] == label;
    });
    if (!one_label)
      continue;
    const Eigen::Vector3d first = pointAt(points, ring[0]);
    const Eigen::Vector3d last = pointAt(points, ring[count - 1]);
    const Eigen::Vector3d twice_area =
        count == 4 ? (pointAt(points, ring[2]) - first)
                         .cross(last - pointAt(points, ring[1]))
                         .eval()
                   : (pointAt(points, ring[1]) - first).cross(last - first).eval();
    areas[label] += 0.5 * twice_area.dot(planes[label].normal);
    return;
  }
}

} // namespace

std::vector<PlaneRegion> gatherRegions(const OrganizedPoints& points,
                                       const std::vector<Plane>& planes,
                                       const std::vector<std::uint16_t>& labels,
                                       int min_points)
{
  const std::size_t count = planes.size();
  std::vector<PlaneRegion> regions(count);
  std::vector<ScatterMatrix> sums(count);
  std::vector<double> areas(count, 0.0);
  std::vector<double> squares(count, 0.0);
  const auto width = static_cast<std::size_t>(points.width);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points.valid[i] != 0) {
      const std::uint16_t l = labels[i];
      const double distance = planes[l].distance(pointAt(points, i));
      regions[l].indices.push_back(static_cast<int>(i));
      sums[l].add(points.x[i], points.y[i], points.z[i]);
      squares[l] += distance * distance;
    }
    if ((i + 1) % width != 0 && i + width < points.size())
      addSquare(points, planes, labels, i, areas);
  }

  std::vector<PlaneRegion> kept;
  for (std::size_t l = 0; l < count; ++l) {
    PlaneRegion& region = regions[l];
    if (region.indices.empty() ||
        region.indices.size() < static_cast<std::size_t>(min_points))
      continue;
    region.plane = planes[l];
    region.label = static_cast<int>(l);
    region.area = std::abs(areas[l]);
    region.rms = std::sqrt(squares[l] / sums[l].n);
    region.centroid = sums[l].centroid();
    region.covariance = sums[l].covariance();
    kept.push_back(std::move(region));
  }
  std::sort(kept.begin(), kept.end(), [](const PlaneRegion& p, const PlaneRegion& q) {
    return std::make_tuple(-p.area, -static_cast<double>(p.indices.size()),
                           p.indices[0]) <
           std::make_tuple(-q.area, -static_cast<double>(q.indices.size()),
                           q.indices[0]);
  });
  return kept;
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
