// SPDX-License-Identifier: BSD-3-Clause
// What the app writes about regions: JSON, mesh, confidence, projected points, the rest.
#include "cli_test.h"
#include "two_planes.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <nlohmann/json.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <cstring>

namespace pcl_mrf_planes::test {

using Json = nlohmann::json;

namespace {

Eigen::Vector3d toPoint(const Json& corner)
{
  return {corner[0].get<double>(), corner[1].get<double>(), corner[2].get<double>()};
}

Eigen::Vector4d coefficientsOf(const Json& plane)
{
  const auto abcd = plane["coefficients"].get<std::vector<double>>();
  return {abcd[0], abcd[1], abcd[2], abcd[3]};
}

} // namespace

class RegionReports : public CliTest {
protected:
  void SetUp() override
  {
    CliTest::SetUp();
    scene_.write(path("in.pcd"), "binary");
  }

  void run(std::vector<std::string> options) const
  {
    options.insert(options.begin(), {path("in.pcd"), "--quiet"});
    const Outcome outcome = segment(options);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }

  Json report() const { return Json::parse(read("m.json")); }

  TwoPlanes scene_;
};

TEST_F(RegionReports, PlanesHaveTheCovarianceOfTheirParameters)
{
  run({"--models", path("m.json")});
  const Json planes = report()["planes"];
  ASSERT_GE(planes.size(), 2U);
  for (const Json& plane : planes) {
    const Json& uncertainty = plane["uncertainty"];
    Eigen::Matrix4d covariance;
    for (Eigen::Index r = 0; r < 4; ++r)
      for (Eigen::Index c = 0; c < 4; ++c)
        covariance(r, c) = uncertainty["covariance"][static_cast<std::size_t>(r)]
                                      [static_cast<std::size_t>(c)];
    EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12);
    EXPECT_GT(covariance.trace(), 0.0);
    EXPECT_LT(
        (covariance.topLeftCorner<3, 3>() * coefficientsOf(plane).head<3>()).norm(),
        1e-3 * covariance.trace())
        << "in the frame of the cloud";
    const Eigen::Vector4d inner = coefficientsOf(uncertainty);
    EXPECT_GT(inner.head<3>().dot(coefficientsOf(plane).head<3>()), 0.999);
    EXPECT_NEAR(inner[3], coefficientsOf(plane)[3], 0.05);
    EXPECT_LT((covariance.topLeftCorner<3, 3>() * inner.head<3>()).norm(),
              1e-6 * covariance.trace())
        << "a unit normal cannot change along itself";
    EXPECT_EQ(uncertainty["bias"].size(), 4U);
    EXPECT_GE(uncertainty["points_per_independent"].get<double>(), 1.0);
    EXPECT_FALSE(plane.contains("patches")) << "only on request";
  }
  EXPECT_FALSE(report().contains("creases")) << "only on request";
}

TEST_F(RegionReports, OutlinesAndCreasesLieOnThePlanes)
{
  run({"--models", path("m.json"), "--outlines", "--creases"});
  const Json planes = report()["planes"];
  EXPECT_FALSE(report().contains("timing"));
  for (const Json& plane : planes) {
    const Eigen::Vector4d abcd = coefficientsOf(plane);
    double area = 0;
    for (const Json& patch : plane["patches"]) {
      EXPECT_GE(patch["outer"].size(), 3U);
      area += patch["area_m2"].get<double>();
      for (const Json& corner : patch["outer"])
        EXPECT_NEAR(abcd.dot(toPoint(corner).homogeneous()), 0.0, 1e-4);
    }
    EXPECT_NEAR(area, plane["area_m2"].get<double>(), 0.2 * area);
    EXPECT_GE(plane["hull"].size(), 3U);
  }
  const Json creases = report()["creases"];
  ASSERT_EQ(creases.size(), 1U) << "wall and floor";
  for (const char* end : {"start", "end"})
    for (const std::size_t label : creases[0]["labels"].get<std::vector<std::size_t>>())
      EXPECT_NEAR(
          coefficientsOf(planes[label - 1]).dot(toPoint(creases[0][end]).homogeneous()),
          0.0, 1e-4);
  EXPECT_NEAR(creases[0]["angle_deg"].get<double>(), 90.0, 1.0);
  EXPECT_FALSE(creases[0]["convex"].get<bool>());
  ASSERT_EQ(report()["relations"].size(), planes.size() * (planes.size() - 1) / 2);
  EXPECT_NEAR(report()["relations"][0]["angle_deg"].get<double>(), 90.0, 1.0);
}

TEST_F(RegionReports, ThePolygonMeshHasTheAreaOfTheOutlines)
{
  run({"--models", path("m.json"), "--outlines", "--polygons", path("p.ply")});
  pcl::PolygonMesh mesh;
  ASSERT_EQ(pcl::io::loadPLYFile(path("p.ply"), mesh), 0);
  pcl::PointCloud<pcl::PointXYZ> corners;
  pcl::fromPCLPointCloud2(mesh.cloud, corners);
  double area = 0;
  for (const pcl::Vertices& triangle : mesh.polygons) {
    ASSERT_EQ(triangle.vertices.size(), 3U);
    const auto corner = [&](std::size_t k) -> Eigen::Vector3f {
      return corners[static_cast<std::size_t>(triangle.vertices[k])].getVector3fMap();
    };
    const Eigen::Vector3f a = corner(0), b = corner(1), c = corner(2);
    area += static_cast<double>((b - a).cross(c - a).norm()) / 2;
  }
  double expected = 0;
  const Json planes = report()["planes"];
  for (const Json& plane : planes)
    for (const Json& patch : plane["patches"])
      expected += patch["area_m2"].get<double>();
  EXPECT_NEAR(area, expected, 0.02 * expected);
}

TEST_F(RegionReports, OutputsGetConfidenceAndPointsOnTheirPlanes)
{
  run({path("out.pcd"), "--models", path("m.json"), "--confidence",
       "--confidence-image", path("c.png"), "--project", "normal", "--rest",
       path("rest.pcd")});
  pcl::PCLPointCloud2 fields;
  ASSERT_EQ(pcl::io::loadPCDFile(path("out.pcd"), fields), 0);
  ASSERT_GE(fields.fields.size(), 2U);
  EXPECT_EQ(fields.fields.back().name, "confidence");
  EXPECT_EQ(fields.fields[fields.fields.size() - 2].name, "label");
  pcl::PointCloud<pcl::PointXYZL> labelled;
  pcl::fromPCLPointCloud2(fields, labelled);
  pcl::PointCloud<pcl::PointXYZ> rest;
  ASSERT_EQ(pcl::io::loadPCDFile(path("rest.pcd"), rest), 0);
  ASSERT_EQ(rest.width, labelled.width) << "rows and columns stay";
  const Json planes = report()["planes"];
  for (std::size_t i = 0; i < labelled.size(); ++i) {
    if (labelled[i].label == 0)
      continue;
    EXPECT_TRUE(std::isnan(rest[i].x)) << "no point of a plane is left";
    const Eigen::Vector4d abcd = coefficientsOf(planes[labelled[i].label - 1]);
    const Eigen::Vector3d p = labelled[i].getVector3fMap().cast<double>();
    ASSERT_NEAR(abcd.dot(p.homogeneous()), 0.0, 2e-4) << "point " << i;
    float confidence = 0;
    std::memcpy(&confidence,
                &fields.data[i * fields.point_step + fields.fields.back().offset],
                sizeof confidence);
    ASSERT_TRUE(confidence >= 0.0f && confidence <= 1.0f);
  }
  EXPECT_EQ(files().count("c.png"), 1U);
}

TEST_F(RegionReports, WhatWasAskedForIsTimed)
{
  run({"--models", path("m.json"), "--timing", "--creases", "--repeat", "2"});
  const Json analysis = report()["timing"]["analysis"];
  EXPECT_EQ(analysis.size(), 2U);
  EXPECT_GT(analysis["uncertainties"]["median"].get<double>(), 0.0);
  EXPECT_GT(analysis["creases"]["min"].get<double>(), 0.0);
}

TEST_F(RegionReports, TheHelpNamesTheOptions)
{
  const std::string help = segment({"--help"}).out;
  for (const char* option :
       {"--separate-patches", "--outlines", "--creases", "--polygons", "--project",
        "--outline-tolerance", "--min-hole-area", "--crease-tolerance",
        "--crease-angle", "--confidence ", "--confidence-image", "--rest"})
    EXPECT_NE(help.find(option), std::string::npos) << option;
}

TEST_F(RegionReports, WhatCannotBeIsRefused)
{
  const std::string in = path("in.pcd");
  const std::string out = path("out.pcd");
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{in, out, "--project", "sideways"}, "normal"},
      {{in, out, "--outline-tolerance", "-1"}, "tolerance"},
      {{in, out, "--outline-tolerance", "much"}, "outline-tolerance"},
      {{in, out, "--crease-angle", "120"}, "angle"},
      {{in, out, "--polygons", out}, "--polygons"},
      {{in, out, "--rest", in}, "--rest"}};
  for (const auto& [arguments, word] : wrong) {
    const Outcome outcome = segment(arguments);
    EXPECT_EQ(outcome.status, 2) << word;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }
  const Outcome outcome = segment({in, "--polygons", path("no/such/p.ply")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(files().size(), 1U) << "nothing is left behind";
}

} // namespace pcl_mrf_planes::test
