// SPDX-License-Identifier: BSD-3-Clause
#include "report_json.h"

#include "output_file.h"
#include "region_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace pcl_mrf_planes::apps {

namespace {

using Json = nlohmann::ordered_json;

/// Keys are names of options, values what the options take: numbers stay numbers.
/// What the report holds beside planes depends on these: one made without them is not the
/// one that is asked for.
void addRegionParameters(const RegionOptions& regions, Json& result)
{
  if (regions.separate_patches)
    result["separate_patches"] = true;
  if (regions.outlines) {
    result["outlines"] = true;
    result["outline_tolerance"] = regions.outline.tolerance;
    result["min_hole_area"] = regions.outline.min_hole_area;
  }
  if (regions.creases) {
    result["creases"] = true;
    result["crease_tolerance"] = regions.crease.tolerance;
    result["crease_angle_rad"] = regions.crease.min_angle;
  }
  if (regions.confidence)
    result["confidence"] = true;
  if (regions.project)
    result["project"] = *regions.project == ProjectionWay::NORMAL ? "normal" : "ray";
}

Json parametersJson(const Options& options)
{
  Json result;
  result["profile"] = options.profile;
  if (options.wrap)
    result["wrap"] = true;
  addRegionParameters(options.regions, result);
  std::vector<ParameterOption> used = parameterOptions(options.parameters.method);
  const std::vector<ParameterOption>& common = commonParameterOptions();
  used.insert(used.end(), common.begin(), common.end());
  for (const ParameterOption& option : used) {
    std::string key = option.name;
    std::replace(key.begin(), key.end(), '-', '_');
    const std::string value = option.print(options.parameters);
    const Json parsed = Json::parse(value, nullptr, false);
    result[key] = parsed.is_discarded() ? Json(value) : parsed;
  }
  return result;
}

Json countsJson(const SegmentedCloud& result)
{
  const SegmentationReport& report = result.report;
  return {{"width", result.labels.width},
          {"height", result.labels.height},
          {"points", report.points},
          {"valid_points", report.valid_points},
          {"tiles_tried", report.tiles_tried},
          {"tiles_kept", report.tiles_kept},
          {"planes_after_merging", report.planes_after_merging},
          {"planes", report.planes},
          {"iterations", report.iterations},
          {"labelled_share", report.labelled_share}};
}

Json planesJson(const SegmentedCloud& result)
{
  Json planes = Json::array();
  for (const PlaneSummary& plane : result.planes) {
    const auto& abcd = plane.coefficients;
    const auto& centroid = plane.centroid;
    planes.push_back({{"label", planes.size() + 1},
                      {"coefficients", {abcd[0], abcd[1], abcd[2], abcd[3]}},
                      {"points", plane.points},
                      {"area_m2", plane.area},
                      {"rms_m", plane.rms},
                      {"centroid", {centroid[0], centroid[1], centroid[2]}}});
    describePlane(result.analysis, planes.size() - 1, planes.back());
  }
  return planes;
}

Json energyJson(const SegmentationReport& report)
{
  Json steps = Json::array();
  for (const FieldEnergy& energy : report.energy)
    steps.push_back({{"data", energy.data},
                     {"smoothness", energy.smoothness},
                     {"total", energy.total()}});
  return steps;
}

Json timingJson(const Timing& timing)
{
  const auto limits = [](const Spread& spread) {
    return Json{{"min", spread.least}, {"max", spread.most}};
  };
  Json result;
  result["runs"] = timing.runs();
  result["total_ms"] = timing.total().median;
  Json spread;
  spread["total_ms"] = limits(timing.total());
  for (const auto& stage : timing.stages()) {
    result["stages"][stage.first] = stage.second.median;
    spread["stages"][stage.first] = limits(stage.second);
  }
  result["spread"] = spread;
  return result;
}

Json cameraJson(const io::CameraModel& camera)
{
  return {{"fx", camera.fx},
          {"fy", camera.fy},
          {"cx", camera.cx},
          {"cy", camera.cy},
          {"source", camera.source}};
}

} // namespace

void writeReport(const std::string& path, const SegmentedFrame& segmented,
                 const Options& options)
{
  const SegmentedCloud& result = segmented.result;
  Json report;
  report["program"] = "pcl_mrf_plane_segmentation";
  report["version"] = PCL_MRF_PLANES_VERSION;
  report["input"] = segmented.source.input;
  report["reader"] = segmented.source.reader;
  if (segmented.frame.camera)
    report["camera"] = cameraJson(*segmented.frame.camera);
  report["counts"] = countsJson(result);
  report["planes"] = planesJson(result);
  if (options.regions.creases)
    describeCreases(result.analysis, report);
  if (!result.report.energy.empty())
    report["energy"] = energyJson(result.report);
  report["parameters"] = parametersJson(options);
  if (options.timing || options.batch.active()) {
    report["timing"] = timingJson(result.timing);
    for (const auto& stage : result.analysis_timing.stages())
      report["timing"]["analysis"][stage.first] = {{"median", stage.second.median},
                                                   {"min", stage.second.least},
                                                   {"max", stage.second.most}};
  }
  const std::string text =
      report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
  writeBytes(path, text);
}

std::optional<ReportedFrame>
readReport(const std::string& path, const std::string& input, const Options& options)
{
  std::ifstream stream(path, std::ios::binary);
  const Json report = Json::parse(stream, nullptr, false);
  try {
    if (report.is_discarded() || report.at("version") != PCL_MRF_PLANES_VERSION ||
        report.at("input") != input ||
        report.at("parameters") != parametersJson(options))
      return std::nullopt;
    const Json& counts = report.at("counts");
    ReportedFrame frame;
    frame.planes = counts.at("planes");
    frame.valid_points = counts.at("valid_points");
    frame.labelled_share = counts.at("labelled_share");
    frame.ms = report.at("timing").at("total_ms");
    return frame;
  }
  catch (const Json::exception&) {
    return std::nullopt;
  }
}

} // namespace pcl_mrf_planes::apps
