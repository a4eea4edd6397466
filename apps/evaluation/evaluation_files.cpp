// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_files.h"

#include "option_values.h"
#include "output_file.h"
#include "text_cells.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace pcl_mrf_planes::evaluation {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::pair<const char*, int RegionCounts::*> COUNTS[] = {
    {"truth", &RegionCounts::truth},   {"correct", &RegionCounts::correct},
    {"over", &RegionCounts::over},     {"under", &RegionCounts::under},
    {"missed", &RegionCounts::missed}, {"noise", &RegionCounts::noise}};

void writeText(const std::string& path, const std::string& text)
{
  apps::writeAtomically(path, [&](const std::string& temporary) {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    if (!stream.flush())
      throw std::runtime_error("cannot write '" + path +
                               "'; check the space on the disk");
  });
}

/// Names and values of a row, the same names for every row.
std::vector<std::pair<std::string, double>> flatten(const ResultRow& row)
{
  std::vector<std::pair<std::string, double>> values = {
      {"frames", static_cast<double>(row.scores.frames)}};
  for (const ScoreColumn& column : scoreColumns())
    values.emplace_back(column.name, row.scores.*column.value);
  for (const BorderSummary& border : row.borders) {
    const std::string name = "border_" + std::to_string(border.distance);
    values.emplace_back(name + "_precision", border.precision);
    values.emplace_back(name + "_recall", border.recall);
    values.emplace_back(name + "_f", border.f);
  }
  values.emplace_back("matching_planes", static_cast<double>(row.planes.planes));
  for (const auto& [name, spread] : {std::pair{"angle_deg", row.planes.angle},
                                     std::pair{"offset_m", row.planes.offset}}) {
    values.emplace_back(name + std::string("_mean"), spread.mean);
    values.emplace_back(name + std::string("_median"), spread.median);
    values.emplace_back(name + std::string("_most"), spread.most);
  }
  return values;
}

Json number(double value)
{
  return std::isnan(value) ? Json() : Json(value);
}

Json countsJson(const RegionCounts& counts)
{
  Json json;
  for (const auto& [name, count] : COUNTS)
    json[name] = counts.*count;
  return json;
}

Json curveJson(const std::vector<CurvePoint>& curve)
{
  Json json = Json::array();
  for (const CurvePoint& point : curve) {
    Json entry = {{"tolerance", point.tolerance}};
    entry.update(countsJson(point.counts));
    json.push_back(entry);
  }
  return json;
}

Json rowJson(const ResultRow& row)
{
  Json json;
  if (row.kind == "frame" || row.kind == "set")
    json["set"] = row.set;
  if (row.kind == "frame")
    json["name"] = row.name;
  for (const auto& [name, value] : flatten(row))
    json[name] = number(value);
  json["frames"] = row.scores.frames; // as a whole number
  json["matching_planes"] = row.planes.planes;
  if (!row.curve.empty())
    json["curve"] = curveJson(row.curve);
  return json;
}

Json frameJson(const FrameResult& frame, const ResultRow& row)
{
  Json json = rowJson(row);
  json.erase("frames");
  json["files"] = {{"truth", frame.files.truth}};
  json["files"]["labels"] = row.has_labels ? Json(frame.files.labels) : Json();
  if (!frame.files.cloud.empty()) {
    json["files"]["cloud"] = frame.files.cloud;
    json["planes"] = Json::array();
    for (const PlaneError& error : frame.planes)
      json["planes"].push_back({{"truth", error.truth},
                                {"label", error.label},
                                {"angle_deg", error.angle},
                                {"offset_m", error.offset}});
  }
  return json;
}

} // namespace

void writeCsv(const std::string& path, const EvaluationResult& result)
{
  std::string text = "kind,set,name,has_labels";
  for (const auto& entry : flatten(result.all))
    text += ',' + entry.first;
  text += '\n';
  for (const ResultRow& row : result.rows(true)) {
    text += row.kind + ',' + apps::csvText(row.set) + ',' + apps::csvText(row.name) +
            ',' + (row.has_labels ? "1" : "0");
    for (const auto& entry : flatten(row))
      text += ',' + (std::isnan(entry.second) ? "" : apps::printReal(entry.second));
    text += '\n';
  }
  writeText(path, text);
}

void writeJson(const std::string& path, const EvaluationResult& result,
               const EvaluationOptions& options)
{
  Json json;
  json["program"] = "pcl_mrf_plane_evaluation";
  json["version"] = PCL_MRF_PLANES_VERSION;
  json["options"] = {{"tolerance", options.score.tolerance},
                     {"min_points", options.score.min_points},
                     {"complete", options.score.complete}};
  json["all"] = rowJson(result.all);
  if (result.mean_of_sets)
    json["mean_of_sets"] = rowJson(*result.mean_of_sets);
  json["sets"] = Json::array();
  for (const ResultRow& row : result.set_rows)
    json["sets"].push_back(rowJson(row));
  json["frames"] = Json::array();
  for (std::size_t i = 0; i < result.frames.size(); ++i)
    json["frames"].push_back(frameJson(result.frames[i], result.frame_rows[i]));
  writeText(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

} // namespace pcl_mrf_planes::evaluation
