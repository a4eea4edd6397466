// SPDX-License-Identifier: BSD-3-Clause
#include "region_options.h"

#include "command_line.h"
#include "option_values.h"

#include <cmath>

namespace pcl_mrf_planes::apps {

namespace po = boost::program_options;

namespace {

constexpr double DEGREE = M_PI / 180.0;

double readReal(const po::variables_map& values, const char* name, double fallback)
{
  return values.count(name) != 0 ? parseReal(name, given(values, name)) : fallback;
}

ProjectionWay parseWay(const std::string& name)
{
  if (name == "normal")
    return ProjectionWay::NORMAL;
  if (name == "ray")
    return ProjectionWay::RAY;
  throw UsageError("--project is '" + name + "'; choose one of normal, ray");
}

std::string printed(double value, const char* unit)
{
  return " (default: " + printReal(value) + " " + unit + ")";
}

} // namespace

std::vector<std::pair<std::string, std::string>> RegionOptions::files() const
{
  return {{"--polygons", polygons},
          {"--confidence-image", confidence_image},
          {"--rest", rest}};
}

bool RegionOptions::writesFiles() const
{
  return !polygons.empty() || !confidence_image.empty() || !rest.empty();
}

bool RegionOptions::any() const
{
  return separate_patches || outlines || creases || confidence || project.has_value() ||
         writesFiles();
}

po::options_description regionOptions()
{
  po::options_description options("Regions");
  const OutlineParameters outline;
  const CreaseParameters crease;
  options.add_options() //
      ("separate-patches", po::bool_switch(),
       "label the connected patches of a plane apart; --min-inliers and --min-area "
       "hold "
       "for each") //
      ("outlines", po::bool_switch(),
       "add patches as polygons with holes, and convex hulls, to --models") //
      ("creases", po::bool_switch(),
       "add where planes meet, angles and distances to --models") //
      ("polygons", text("FILE.ply"),
       "write the outlines as a mesh, coloured by label") //
      ("outline-tolerance", text("M"),
       ("a corner is left out if the line stays so near it" +
        printed(outline.tolerance, "m"))
           .c_str()) //
      ("min-hole-area", text("M2"),
       ("smaller holes of outlines are filled" + printed(outline.min_hole_area, "m2"))
           .c_str()) //
      ("crease-tolerance", text("M"),
       ("distance of the border's points to the crease" +
        printed(crease.tolerance, "m"))
           .c_str()) //
      ("crease-angle", text("DEGREES"),
       ("least angle of planes that make a crease" +
        printed(std::round(crease.min_angle / DEGREE), "degrees"))
           .c_str()) //
      ("confidence", po::bool_switch(),
       "add a field confidence, 0 to 1, to OUT.pcd") //
      ("confidence-image", text("FILE.png"),
       "write the confidence as a 16-bit gray picture, 65535 for 1") //
      ("project", text("normal|ray"),
       "move the points of OUT.pcd onto their planes, the shortest way or along the "
       "viewing ray") //
      ("rest", text("FILE.pcd"),
       "write the cloud without the points of planes (their coordinates NaN)");
  return options;
}

RegionOptions readRegionOptions(const po::variables_map& values)
{
  RegionOptions options;
  options.separate_patches = values["separate-patches"].as<bool>();
  options.outlines = values["outlines"].as<bool>();
  options.creases = values["creases"].as<bool>();
  options.confidence = values["confidence"].as<bool>();
  options.confidence_image = given(values, "confidence-image");
  options.polygons = given(values, "polygons");
  options.rest = given(values, "rest");
  if (values.count("project") != 0)
    options.project = parseWay(given(values, "project"));
  options.outline.tolerance =
      readReal(values, "outline-tolerance", options.outline.tolerance);
  options.outline.min_hole_area =
      readReal(values, "min-hole-area", options.outline.min_hole_area);
  options.crease.tolerance =
      readReal(values, "crease-tolerance", options.crease.tolerance);
  options.crease.min_angle =
      readReal(values, "crease-angle", options.crease.min_angle / DEGREE) * DEGREE;
  for (const std::string& complaint :
       {options.outline.validate(), options.crease.validate()})
    if (!complaint.empty())
      throw UsageError(complaint + "; see --outline-tolerance, --min-hole-area, "
                                   "--crease-tolerance and --crease-angle in --help");
  return options;
}

} // namespace pcl_mrf_planes::apps
