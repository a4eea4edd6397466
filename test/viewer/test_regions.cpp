// SPDX-License-Identifier: BSD-3-Clause
/** \file What follows from the planes of a view: shapes, moved points, deviations; and the
 * labels that came with a frame. */
#include "label_colours.h"
#include "model_test.h"
#include "point_colours.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <cmath>

namespace pcl_mrf_planes::test {

namespace {

using namespace viewer;

class Regions : public ModelTest {};

double distance(const ViewPlane& plane, const Eigen::Vector3d& p)
{
  return plane.normal.dot(p) + plane.d;
}

double areaOf(const PlaneRing& ring, const Eigen::Vector3d& normal)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < ring.size(); ++k)
    sum += ring[k].cross(ring[(k + 1) % ring.size()]);
  return 0.5 * std::abs(sum.dot(normal));
}

TEST_F(Regions, KeyGoesThroughTheShapes)
{
  Session session = open({room("room.pcd")});
  std::vector<Shapes> seen;
  for (int k = 0; k < 3; ++k) {
    session.perform(Action::SHAPES);
    seen.push_back(session.settings.shapes);
  }
  EXPECT_EQ(seen, (std::vector<Shapes>{Shapes::POLYGONS, Shapes::HULLS, Shapes::OFF}));
}

TEST_F(Regions, ShapesLieOnTheirPlanesAndAreOfTheirArea)
{
  Session session = open({room("room.pcd")});
  const SegmentedView& view = session.main();
  const std::vector<RegionOutline> outlines = view.outlines();
  ASSERT_EQ(outlines.size(), view.planes.size());
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    const ViewPlane& plane = view.planes[k];
    double area = 0.0;
    for (const PlanePolygon& patch : outlines[k].patches) {
      area += areaOf(patch.outer, plane.normal);
      for (const PlaneRing& hole : patch.holes)
        area -= areaOf(hole, plane.normal);
      for (const Eigen::Vector3d& corner : patch.outer)
        EXPECT_NEAR(distance(plane, corner), 0.0, 1e-3) << k;
    }
    // The area of a region is that of its points: more or less where it is oblique.
    EXPECT_LT(area, 1.6 * plane.area) << k;
    EXPECT_GT(area, plane.area / 1.6) << k;
    EXPECT_GE(areaOf(outlines[k].hull, plane.normal), 0.99 * area) << k;
  }
}

TEST_F(Regions, MovedPointsLieOnTheirPlanesInTheirRays)
{
  Session session = open({room("room.pcd")});
  session.perform(Action::PROJECTION);
  EXPECT_TRUE(session.settings.projected);
  const SegmentedView& view = session.main();
  const pcl::PointCloud<pcl::PointXYZ>& before = *session.frame().cloud;
  const auto after = view.projected();
  ASSERT_EQ(after->size(), before.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (session.frame().points.valid[i] == 0)
      continue;
    const Eigen::Vector3d p = before[i].getVector3fMap().cast<double>();
    const Eigen::Vector3d q = (*after)[i].getVector3fMap().cast<double>();
    if (view.labels[i] == 0) {
      EXPECT_EQ(p, q);
      continue;
    }
    EXPECT_NEAR(distance(view.planes[view.labels[i] - 1u], q), 0.0, 1e-3);
    EXPECT_LT(p.cross(q).norm(), 1e-4 * p.squaredNorm()) << "off its ray";
    moved += (p - q).norm() > 1e-4;
  }
  EXPECT_GT(moved, before.size() / 2);
}

TEST_F(Regions, DeviationGrowsFromTheCentroid)
{
  Session session = open({room("room.pcd")});
  const std::vector<PlaneUncertainty> expected = uncertaintiesOf(session);
  const std::vector<PlaneDeviations> deviations = session.main().deviations();
  ASSERT_EQ(deviations.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const PlaneUncertainty& plane = expected[k];
    // Errors of the turn and of the place at the centroid hardly hang together.
    const double middle = std::sqrt(plane.at_centroid(2, 2));
    EXPECT_NEAR(deviationAt(plane.centroid, deviations[k]), middle, 0.01 * middle) << k;
    const Eigen::Vector3d far = plane.centroid + 100.0 * plane.basis.col(0);
    const double turned = 100.0 * std::sqrt(plane.at_centroid(0, 0));
    EXPECT_NEAR(deviationAt(far, deviations[k]), turned, 0.05 * turned) << k;
  }
}

TEST_F(Regions, ColoursByDeviationHaveAScaleByFactors)
{
  Session session = open({room("room.pcd")});
  session.perform(Action::BY_DEVIATION);
  const PointColours colours =
      colourPoints(session.frame(), session.main(), {}, session.settings, {});
  ASSERT_TRUE(colours.scale);
  EXPECT_TRUE(colours.scale->logarithmic);
  EXPECT_GT(colours.scale->low, 0.0);
  EXPECT_LT(colours.scale->low, colours.scale->high);
  const double middle = std::sqrt(colours.scale->low * colours.scale->high);
  EXPECT_NEAR(colours.scale->shareOf(middle), 0.5, 1e-9);
  EXPECT_NEAR(colours.scale->shareOf(0.0), 0.0, 1e-9);
  EXPECT_NE(colours.legend.find("mm"), std::string::npos);
}

TEST_F(Regions, LabelsOfAFileAreShownAsTheyAre)
{
  const std::string plain = room("room.pcd");
  ASSERT_EQ(segment({plain, path("labelled.pcd"), "--quiet"}).status, 0);
  Session session = open({path("labelled.pcd")}, Profile::PAPER); // another result
  session.perform(Action::BY_GIVEN_LABEL);
  const Session direct = open({plain});
  const PointColours colours =
      colourPoints(session.frame(), session.main(), {}, session.settings, {});
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < colours.colours.size(); ++i) {
    EXPECT_EQ(colours.colours[i], apps::labelColour(direct.main().labels[i]));
    labelled += direct.main().labels[i] != 0;
  }
  EXPECT_GT(labelled, colours.colours.size() / 2);
  EXPECT_TRUE(direct.frame().given.empty());
  const PointColours none =
      colourPoints(direct.frame(), direct.main(), {}, session.settings, {});
  EXPECT_NE(none.legend.find("no labels"), std::string::npos) << none.legend;
}

} // namespace

} // namespace pcl_mrf_planes::test
