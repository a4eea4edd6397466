// SPDX-License-Identifier: BSD-3-Clause
#include "reference/ray_images.h"

#include "pixel_rings.h"
#include "polygon_simplification.h"

#include <pcl_mrf_planes/plane_segmentation.h>
#include <pcl_mrf_planes/region_contour.h>
#include <pcl_mrf_planes/region_polygons.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace pcl_mrf_planes {
namespace {

/// In axes of the plane, as the sensor sees it.
FlatPolygon flatten(const PlanePolygon& polygon, const Plane& plane)
{
  const Eigen::Vector3d right = plane.normal.unitOrthogonal();
  const Eigen::Vector3d up = plane.normal.cross(right);
  const auto flat = [&](const PlaneRing& ring) {
    FlatRing out;
    for (const Eigen::Vector3d& corner : ring) {
      EXPECT_NEAR(plane.distance(corner), 0.0, 1e-6) << "a corner off its plane";
      out.emplace_back(right.dot(corner), up.dot(corner));
    }
    return out;
  };
  FlatPolygon out = {flat(polygon.outer)};
  for (const PlaneRing& hole : polygon.holes)
    out.push_back(flat(hole));
  return out;
}

double distanceToBorder(const Eigen::Vector2d& p, const FlatPolygon& polygon)
{
  double least = INFINITY;
  for (const FlatRing& ring : polygon)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d a = ring[k];
      const Eigen::Vector2d way = ring[(k + 1) % ring.size()] - a;
      const double t = std::clamp((p - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
      least = std::fmin(least, (p - a - t * way).norm());
    }
  return least;
}

bool isInside(const Eigen::Vector2d& p, const FlatPolygon& polygon)
{
  bool inside = false;
  for (const FlatRing& ring : polygon)
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2d& a = ring[k];
      const Eigen::Vector2d& b = ring[(k + 1) % ring.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()) &&
          p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        inside = !inside;
    }
  return inside;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// Whether two edges cross, not counting ends that touch; without Boost.
bool doCross(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
             const Eigen::Vector2d& c, const Eigen::Vector2d& d)
{
  const double of_c = cross(b - a, c - a);
  const double of_d = cross(b - a, d - a);
  const double of_a = cross(d - c, a - c);
  const double of_b = cross(d - c, b - c);
  const double least = 1e-12;
  return of_c * of_d < -least * least && of_a * of_b < -least * least &&
         std::fmin(std::abs(of_c), std::abs(of_d)) > least &&
         std::fmin(std::abs(of_a), std::abs(of_b)) > least;
}

bool hasCrossing(const FlatPolygon& polygon)
{
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> edges;
  for (const FlatRing& ring : polygon)
    for (std::size_t k = 0; k < ring.size(); ++k)
      edges.emplace_back(ring[k], ring[(k + 1) % ring.size()]);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (doCross(edges[i].first, edges[i].second, edges[j].first, edges[j].second))
        return true;
  return false;
}

TEST(PixelRingsTest, RingsEncloseThePixelsAndNeverMeetThemselves)
{
  scenes::Random random(1);
  for (int run = 0; run < 200; ++run) {
    const int width = random.integer(1, 30);
    const int height = random.integer(1, 30);
    auto labels = reference::raggedLabels(random, width, height, 2);
    for (std::uint16_t& label : labels)
      label = label == NO_PLANE ? 0 : static_cast<std::uint16_t>(label + 1);
    const ConnectedParts parts = findConnectedParts(labels, width, height);
    const LabelRuns image = findRuns(labels, width, 0);
    const auto rings = tracePixelRings(image, connectRuns(image));
    ASSERT_EQ(rings.size(), parts.size.size());
    for (std::size_t k = 0; k < rings.size(); ++k) {
      int twice_area = 0;
      for (std::size_t r = 0; r < rings[k].size(); ++r) {
        int mine = 0;
        std::set<std::pair<int, int>> corners;
        const auto& ring = rings[k][r];
        for (std::size_t c = 0; c < ring.size(); ++c) {
          const PixelCorner& a = ring[c];
          const PixelCorner& b = ring[(c + 1) % ring.size()];
          ASSERT_EQ(std::abs(a.x - b.x) + std::abs(a.y - b.y), 1) << "edge by edge";
          mine += a.x * b.y - b.x * a.y;
          ASSERT_TRUE(corners.emplace(a.x, a.y).second) << "a ring that meets itself";
          ASSERT_EQ(parts.part_of_point[static_cast<std::size_t>(a.pixel)],
                    static_cast<int>(k));
        }
        EXPECT_EQ(mine > 0, r == 0) << "the outer ring first";
        twice_area += mine;
      }
      ASSERT_EQ(twice_area, 2 * parts.size[k]) << "area of the pixels";
    }
  }
}

class PolygonTest : public testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(Sensors, PolygonTest, testing::Values(false, true),
                         [](const auto& one) {
                           return std::string(one.param ? "Lidar" : "Camera");
                         });

TEST_P(PolygonTest, RaggedRegionsHaveValidPolygonsAtEveryTolerance)
{
  scenes::Random random(2);
  int patches = 0;
  int holes = 0;
  for (int run = 0; run < 150; ++run) {
    const auto input = reference::raggedPoints(random, GetParam());
    const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
    OutlineParameters parameters;
    parameters.tolerance = run % 3 == 0 ? 0.0 : random.uniform(0.001, 0.3);
    const auto outlines = outlineRegions(input.points, regions, parameters);
    ASSERT_EQ(outlines.size(), regions.size());
    for (std::size_t k = 0; k < regions.size(); ++k) {
      int points = 0;
      for (const PlanePolygon& patch : outlines[k].patches) {
        const FlatPolygon flat = flatten(patch, regions[k].plane);
        ASSERT_TRUE(isValidPolygon(flat)) << "run " << run << ", region " << k;
        ASSERT_FALSE(hasCrossing(flat)) << "run " << run << ", region " << k;
        EXPECT_GT(patch.area, 0.0);
        points += patch.points;
        holes += static_cast<int>(patch.holes.size());
        ++patches;
      }
      ASSERT_EQ(points, static_cast<int>(regions[k].indices.size()))
          << "every patch has a polygon";
    }
  }
  EXPECT_GT(patches, 1000);
  EXPECT_GT(holes, 100);
}

TEST_P(PolygonTest, PointsLieInsideTheirPolygonAndNoOtherOfTheirPlane)
{
  scenes::Random random(3);
  for (int run = 0; run < 20; ++run) {
    const auto input = reference::raggedPoints(random, GetParam());
    const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
    OutlineParameters exact;
    exact.tolerance = 0.0;
    const auto outlines = outlineRegions(input.points, regions, exact);
    for (std::size_t k = 0; k < regions.size(); ++k)
      for (const int i : regions[k].indices) {
        const auto at = static_cast<std::size_t>(i);
        PlanePolygon point;
        point.outer.emplace_back(input.points.x[at], input.points.y[at],
                                 input.points.z[at]);
        const Eigen::Vector2d p = flatten(point, regions[k].plane)[0][0];
        int around = 0;
        for (const PlanePolygon& patch : outlines[k].patches)
          around += isInside(p, flatten(patch, regions[k].plane)) ? 1 : 0;
        ASSERT_EQ(around, 1) << "point " << i << " of run " << run;
      }
  }
}

TEST_P(PolygonTest, SimplifiedBordersStayWithinTheTolerance)
{
  scenes::Random random(6);
  for (int run = 0; run < 30; ++run) {
    const auto input = reference::raggedPoints(random, GetParam());
    const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
    OutlineParameters parameters;
    parameters.tolerance = 0.0;
    const auto exact = outlineRegions(input.points, regions, parameters);
    parameters.tolerance = 0.05;
    const auto simple = outlineRegions(input.points, regions, parameters);
    for (std::size_t k = 0; k < regions.size(); ++k)
      for (std::size_t p = 0; p < exact[k].patches.size(); ++p) {
        const FlatPolygon border = flatten(simple[k].patches[p], regions[k].plane);
        EXPECT_LE(simple[k].patches[p].outer.size(), exact[k].patches[p].outer.size());
        for (const FlatRing& ring : flatten(exact[k].patches[p], regions[k].plane))
          for (const Eigen::Vector2d& corner : ring)
            ASSERT_LE(distanceToBorder(corner, border), 0.05 + 1e-9);
      }
  }
}

/// A wall of 1.2 x 1 m with a window of 0.4 x 0.3 m, seen obliquely.
scenes::SceneFrame wallWithWindow(const scenes::SensorNoise& noise)
{
  scenes::Scene scene;
  scene.beginObject();
  const Eigen::Vector3d across(1.2 * std::cos(0.6), 1.2 * std::sin(0.6), 0.0);
  const Eigen::Vector3d up(0, 0, 1);
  const Eigen::Vector3d corner = Eigen::Vector3d(0, 2, 0) - across / 2 - up / 2;
  const auto piece = [&](double left, double bottom, double right, double top) {
    const Eigen::Vector3d a = corner + left / 1.2 * across + bottom * up;
    const Eigen::Vector3d w = (right - left) / 1.2 * across;
    const Eigen::Vector3d h = (top - bottom) * up;
    return std::vector<Eigen::Vector3d>{a, a + w, a + w + h, a + h};
  };
  const scenes::Colour gray(0.5, 0.5, 0.5);
  const int plane = scene.addPolygon(piece(0, 0, 1.2, 0.4), gray);
  scene.addPiece(plane, piece(0, 0.7, 1.2, 1), gray);
  scene.addPiece(plane, piece(0, 0.4, 0.3, 0.7), gray);
  scene.addPiece(plane, piece(0.7, 0.4, 1.2, 0.7), gray);
  return scenes::render(scene, scenes::lookAt({0, 0, 0}, {0, 1, 0}), noise, 1);
}

TEST(RegionPolygonsTest, AWallWithAWindowIsARectangleWithAHole)
{
  for (const double sigma : {0.0, 0.005}) {
    const auto frame = wallWithWindow(scenes::SensorNoise::gaussian(sigma));
    const OrganizedPoints points = reference::toPoints(frame);
    const Plane plane = {frame.planes[0].head<3>(), frame.planes[0][3]};
    const auto regions =
        gatherRegions(points, {plane}, std::vector<std::uint16_t>(points.size(), 0), 0);
    const auto outlines = outlineRegions(points, regions);
    ASSERT_EQ(outlines[0].patches.size(), 1U);
    const PlanePolygon& wall = outlines[0].patches[0];
    EXPECT_EQ(wall.outer.size(), 4U) << "four corners are left";
    ASSERT_EQ(wall.holes.size(), 1U);
    EXPECT_EQ(wall.holes[0].size(), 4U);
    EXPECT_NEAR(wall.area, 1.2 - 0.12, 0.01);
    PlanePolygon hull;
    hull.outer = outlines[0].hull;
    EXPECT_NEAR(polygonArea(flatten(hull, plane)), 1.2, 0.012);
    OutlineParameters filled;
    filled.min_hole_area = 0.2;
    EXPECT_TRUE(outlineRegions(points, regions, filled)[0].patches[0].holes.empty());
  }
}

TEST(RegionPolygonsTest, HullsHoldAllCornersAndAreConvex)
{
  scenes::Random random(9);
  for (int run = 0; run < 40; ++run) {
    const auto input = reference::raggedPoints(random, run % 2 == 0);
    const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
    const auto outlines = outlineRegions(input.points, regions);
    for (std::size_t k = 0; k < regions.size(); ++k) {
      PlanePolygon hull;
      hull.outer = outlines[k].hull;
      const FlatRing ring = flatten(hull, regions[k].plane)[0];
      ASSERT_GE(ring.size(), 3U);
      for (const PlanePolygon& patch : outlines[k].patches) {
        const FlatPolygon flat = flatten(patch, regions[k].plane);
        for (const Eigen::Vector2d& p : flat[0])
          for (std::size_t c = 0; c < ring.size(); ++c) {
            const Eigen::Vector2d way = ring[(c + 1) % ring.size()] - ring[c];
            const Eigen::Vector2d to = p - ring[c];
            ASSERT_GE(way.x() * to.y() - way.y() * to.x(), -1e-9) << "outside the hull";
          }
      }
    }
  }
}

TEST(RegionPolygonsTest, SmallPatchesAreLeftOut)
{
  scenes::Random random(10);
  const auto input = reference::raggedPoints(random, false);
  const auto regions = gatherRegions(input.points, input.planes, input.labels, 0);
  OutlineParameters parameters;
  parameters.min_points = 5;
  parameters.min_area = 0.01;
  for (const RegionOutline& outline : outlineRegions(input.points, regions, parameters))
    for (const PlanePolygon& patch : outline.patches) {
      EXPECT_GE(patch.points, 5);
      EXPECT_GE(patch.area, 0.01);
    }
  parameters.min_points = 1000000;
  for (const RegionOutline& outline : outlineRegions(input.points, regions, parameters))
    EXPECT_TRUE(outline.patches.empty() && outline.hull.empty());
  EXPECT_TRUE(outlineRegions(input.points, {}).empty());
}

TEST(RegionPolygonsTest, RaysThatCrossStillGiveValidPolygons)
{
  // No sensor does this: the columns of the image in any order.
  scenes::Random random(11);
  for (int run = 0; run < 20; ++run) {
    OrganizedPoints points;
    points.resize(12, 9);
    for (std::size_t i = 0; i < points.size(); ++i)
      points.set(i, static_cast<float>(random.uniform(-1, 1)),
                 static_cast<float>(random.uniform(-1, 1)), 2.0f);
    const auto labels = reference::raggedLabels(random, 12, 9, 1);
    const auto regions = gatherRegions(points, {{{0, 0, -1}, 2}}, labels, 0);
    for (const RegionOutline& outline : outlineRegions(points, regions))
      for (const PlanePolygon& patch : outline.patches)
        EXPECT_TRUE(isValidPolygon(flatten(patch, regions[0].plane)));
  }
}

TEST(RegionPolygonsTest, AColumnOfPointsWithoutNeighboursHasNoPolygon)
{
  // From one column no ray beside it is known: the patch has no width.
  OrganizedPoints points;
  points.resize(9, 12);
  const std::vector<std::uint16_t> labels(points.size(), 0);
  for (std::size_t y = 0; y < 12; ++y)
    points.set(9 * y + 4, 0.2f, 0.1f * static_cast<float>(y), 2.0f);
  const auto regions = gatherRegions(points, {{{0, 0, -1}, 2}}, labels, 0);
  ASSERT_EQ(regions.size(), 1u);
  const auto outlines = outlineRegions(points, regions);
  ASSERT_EQ(outlines.size(), 1u);
  EXPECT_TRUE(outlines[0].patches.empty());
  EXPECT_TRUE(outlines[0].hull.empty());
}

TEST(PolygonSimplification, NothingIsNoPolygon)
{
  EXPECT_TRUE(convexHull({}).empty());
  EXPECT_FALSE(isValidPolygon({}));
  EXPECT_FALSE(isValidPolygon({{}}));
}

TEST(PolygonSimplification, HolesBehindOneThatIsLeftOutStay)
{
  const auto square = [](double x, double y, double side) {
    return FlatRing{{x, y}, {x, y + side}, {x + side, y + side}, {x + side, y}};
  };
  const FlatPolygon simple =
      simplifyPolygon({square(0, 0, 9), square(1, 1, 0.1), square(4, 4, 3)},
                      FixedCorners(3, std::vector<std::uint8_t>(4)), 0.01, 0.5);
  ASSERT_EQ(simple.size(), 2u);
  EXPECT_NEAR(polygonArea(simple), 81.0 - 9.0, 1e-12);
  EXPECT_NEAR(polygonArea({simple[0]}), 81.0, 1e-12) << "outer ring counterclockwise";
}

TEST(PolygonSimplification, ALoopWithinTheToleranceIsLeftOut)
{
  // The border comes back to (2, 4), where another ring meets it, by a small loop.
  const FlatRing ring = {{0, 0},     {4, 0},     {4, 4}, {2, 4},
                         {2.1, 4.1}, {1.9, 4.1}, {2, 4}, {0, 4}};
  const FixedCorners fixed = {{0, 0, 0, 1, 0, 0, 1, 0}};
  const FlatPolygon simple = simplifyPolygon({ring}, fixed, 0.5, 0.0);
  ASSERT_EQ(simple.size(), 1u);
  EXPECT_TRUE(isValidPolygon(simple));
  EXPECT_NEAR(polygonArea(simple), 16.0, 1e-12);
  EXPECT_EQ(std::count(simple[0].begin(), simple[0].end(), Eigen::Vector2d(2, 4)), 1)
      << "a corner that must stay stays, once";
}

/// Area of the pixels of a pinhole camera, seen onto a plane: z^3 / (d f^2) each.
double pixelArea(const scenes::SceneFrame& frame, const PlaneRegion& region)
{
  const double f = std::get<scenes::Pinhole>(frame.camera.projection).fx;
  double area = 0;
  for (const int i : region.indices) {
    const Eigen::Vector3d ray =
        frame.camera.direction(i % frame.width, i / frame.width);
    const double z = -region.plane.d / region.plane.normal.dot(ray);
    area += z * z * z / (region.plane.d * f * f);
  }
  return area;
}

TEST(RegionPolygonsTest, SegmentedRoomsHaveValidPolygonsOfTheirArea)
{
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const auto frame =
        reference::takePicture("room", 320, 240, seed, scenes::SensorNoise::kinect());
    const OrganizedPoints points = reference::toPoints(frame);
    const auto regions = segmentPlanes(points, Parameters()).regions;
    for (const double tolerance : {0.0, 0.01, 0.05}) {
      OutlineParameters parameters;
      parameters.tolerance = tolerance;
      const auto outlines = outlineRegions(points, regions, parameters);
      for (std::size_t k = 0; k < regions.size(); ++k) {
        double area = 0;
        for (const PlanePolygon& patch : outlines[k].patches) {
          EXPECT_TRUE(isValidPolygon(flatten(patch, regions[k].plane)));
          area += patch.area;
        }
        const double expected = pixelArea(frame, regions[k]);
        if (tolerance == 0.0) {
          EXPECT_NEAR(area, expected, 0.005 * expected);
        }
      }
    }
  }
}

TEST(OutlineParametersTest, WhatCannotBeIsRefused)
{
  OutlineParameters parameters;
  EXPECT_TRUE(parameters.validate().empty());
  parameters.tolerance = -1;
  EXPECT_NE(parameters.validate().find("tolerance"), std::string::npos);
  parameters.tolerance = std::nan("");
  EXPECT_FALSE(parameters.validate().empty());
  parameters = {};
  parameters.min_hole_area = -1;
  EXPECT_FALSE(parameters.validate().empty());
  parameters = {};
  parameters.min_area = std::nan("");
  EXPECT_NE(parameters.validate().find("areas"), std::string::npos);
  parameters = {};
  parameters.min_points = -1;
  EXPECT_NE(parameters.validate().find("points"), std::string::npos);
}

TEST(RegionPolygonsTest, EveryCornerComesIntoTheFrameOfTheCloud)
{
  const Eigen::Vector3d corner(1, 2, 3);
  RegionOutline outline;
  outline.hull = {corner};
  outline.patches.resize(2);
  for (PlanePolygon& patch : outline.patches) {
    patch.outer = {corner};
    patch.holes = {{corner}, {corner}};
  }
  SensorPose pose;
  pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1; // a quarter turn around z
  pose.origin = {10, 20, 30};
  const RegionOutline moved = inCloudFrame(outline, pose);
  const PlaneRing expected = {{8, 21, 33}};
  EXPECT_EQ(moved.hull, expected);
  ASSERT_EQ(moved.patches.size(), 2U);
  for (const PlanePolygon& patch : moved.patches) {
    EXPECT_EQ(patch.outer, expected);
    EXPECT_EQ(patch.holes, (std::vector<PlaneRing>{expected, expected}));
  }
}

} // namespace
} // namespace pcl_mrf_planes
