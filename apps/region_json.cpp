// SPDX-License-Identifier: BSD-3-Clause
#include "region_json.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace pcl_mrf_planes::apps {

namespace {

using Json = nlohmann::ordered_json;

constexpr double DEGREES = 180.0 / M_PI;

Json pointJson(const Eigen::Vector3d& p)
{
  return {p.x(), p.y(), p.z()};
}

Json ringJson(const PlaneRing& ring)
{
  Json corners = Json::array();
  for (const Eigen::Vector3d& corner : ring)
    corners.push_back(pointJson(corner));
  return corners;
}

Json uncertaintyJson(const PlaneUncertainty& uncertainty)
{
  if (!uncertainty.valid)
    return nullptr;
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < 4; ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < 4; ++c)
      row.push_back(uncertainty.covariance(r, c));
    rows.push_back(row);
  }
  const Eigen::Vector4d& bias = uncertainty.bias;
  const Plane& plane = uncertainty.plane;
  return {
      {"coefficients", {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.d}},
      {"covariance", rows},
      {"bias", {bias[0], bias[1], bias[2], bias[3]}},
      {"points_per_independent", uncertainty.points_per_independent}};
}

Json patchJson(const PlanePolygon& patch)
{
  Json holes = Json::array();
  for (const PlaneRing& hole : patch.holes)
    holes.push_back(ringJson(hole));
  return {{"points", patch.points},
          {"area_m2", patch.area},
          {"outer", ringJson(patch.outer)},
          {"holes", holes}};
}

} // namespace

void describePlane(const RegionAnalysis& analysis, std::size_t k, Json& plane)
{
  if (k < analysis.uncertainties.size())
    plane["uncertainty"] = uncertaintyJson(analysis.uncertainties[k]);
  if (k >= analysis.outlines.size())
    return;
  plane["patches"] = Json::array();
  for (const PlanePolygon& patch : analysis.outlines[k].patches)
    plane["patches"].push_back(patchJson(patch));
  plane["hull"] = ringJson(analysis.outlines[k].hull);
}

void describeCreases(const RegionAnalysis& analysis, Json& report)
{
  report["creases"] = Json::array();
  for (const PlaneCrease& crease : analysis.creases)
    report["creases"].push_back({{"labels", {crease.first + 1, crease.second + 1}},
                                 {"start", pointJson(crease.start)},
                                 {"end", pointJson(crease.end)},
                                 {"length_m", crease.length()},
                                 {"angle_deg", crease.angle * DEGREES},
                                 {"convex", crease.convex},
                                 {"points", crease.points}});
  report["relations"] = Json::array();
  for (const RegionRelation& relation : analysis.relations)
    report["relations"].push_back(
        {{"labels", {relation.first + 1, relation.second + 1}},
         {"angle_deg", relation.angle * DEGREES},
         {"distance_m", relation.distance}});
}

} // namespace pcl_mrf_planes::apps
