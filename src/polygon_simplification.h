// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// Polygons in a plane. Every ring names its corners once; the outer one comes first.
using FlatRing = std::vector<Eigen::Vector2d>;
using FlatPolygon = std::vector<FlatRing>;

/// Corners of each ring that must stay: those that other rings meet.
using FixedCorners = std::vector<std::vector<std::uint8_t>>;

/// Leave out corners while the border stays within the tolerance and the polygon valid by
/// boost::geometry::is_valid; outer ring counterclockwise, holes clockwise. Halves the
/// tolerance where rings would cross; the convex hull if the polygon was not valid itself.
/// Holes of less than an area are left out. Empty without an area.
/// O(corners log corners), times the halvings
FlatPolygon simplifyPolygon(FlatPolygon polygon, const FixedCorners& fixed,
                            double tolerance, double min_hole_area);

FlatRing convexHull(const FlatRing& corners);

/// Area less the holes.
double polygonArea(const FlatPolygon& polygon);

bool isValidPolygon(const FlatPolygon& polygon);

} // namespace pcl_mrf_planes
