// SPDX-License-Identifier: BSD-3-Clause
#include "result_table.h"

#include "evaluation/contingency_table.h"
#include "evaluation/score_summary.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>

namespace pcl_mrf_planes::benchmarks {

namespace {

using evaluation::ScoreSummary;
using evaluation::SegmentationScore;

std::string partOf(const std::string& path)
{
  return path + ".part";
}

/// Ratio follows from the counts, and has no meaning in a single frame.
std::vector<evaluation::ScoreColumn> columns()
{
  std::vector<evaluation::ScoreColumn> all = evaluation::scoreColumns();
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const evaluation::ScoreColumn& column) {
                             return std::string(column.name) == "ratio";
                           }),
            all.end());
  return all;
}

/// All results of a method with a setting.
struct MethodResults {
  std::string name;
  std::map<std::string, std::vector<SegmentationScore>> scores; ///< by set
  std::vector<double> milliseconds;                             ///< at 640x480
};

std::vector<MethodResults> byMethod(const std::vector<Result>& results)
{
  std::vector<MethodResults> methods;
  for (const Result& result : results) {
    const std::string name = result.method + ' ' + result.setting;
    auto method = std::find_if(methods.begin(), methods.end(),
                               [&](const MethodResults& m) { return m.name == name; });
    if (method == methods.end())
      method = methods.insert(methods.end(), {name, {}, {}});
    if (result.score)
      method->scores[result.set].push_back(*result.score);
    if (result.width == 640 && result.height == 480)
      method->milliseconds.push_back(result.milliseconds);
  }
  return methods;
}

double medianOf(std::vector<double> values)
{
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

} // namespace

void scoreAgainst(const evaluation::LabelImage& truth,
                  const evaluation::LabelImage& labels, Result& result)
{
  const evaluation::ContingencyTable table = evaluation::compareLabels(truth, labels);
  result.score = evaluation::scoreTable(table);
  result.curve = evaluation::toleranceCurve(table, 0);
}

ResultFile::ResultFile(const std::string& path, const std::string& names)
: path_(path)
, stream_(partOf(path))
{
  stream_.imbue(std::locale::classic());
  stream_ << names << ",set,frame,width,height,milliseconds";
  for (const evaluation::ScoreColumn& column : columns())
    stream_ << ',' << column.name;
  for (const double tolerance : evaluation::curveTolerances())
    stream_ << ",correct_" << tolerance;
  if (!(stream_ << std::endl))
    throw std::runtime_error("cannot write '" + partOf(path) + "'");
}

void ResultFile::add(const Result& result)
{
  stream_ << result.method << ',' << result.setting << ',' << result.set << ','
          << result.frame << ',' << result.width << ',' << result.height << ','
          << result.milliseconds;
  const ScoreSummary numbers =
      result.score ? evaluation::summarize({*result.score}) : ScoreSummary();
  for (const evaluation::ScoreColumn& column : columns()) {
    stream_ << ',';
    if (!std::isnan(numbers.*column.value))
      stream_ << numbers.*column.value;
  }
  // Without ground truth as many empty columns as tolerances.
  for (std::size_t k = 0; k < evaluation::curveTolerances().size(); ++k) {
    stream_ << ',';
    if (k < result.curve.size())
      stream_ << result.curve[k].counts.correct;
  }
  stream_ << std::endl; // an interrupted run keeps what it has
}

void ResultFile::finish()
{
  stream_.close();
  if (!stream_)
    throw std::runtime_error("cannot write all of '" + partOf(path_) + "'");
  std::filesystem::rename(partOf(path_), path_);
}

std::string summaryOf(const std::vector<Result>& results)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed;
  for (const MethodResults& method : byMethod(results)) {
    text << method.name << ':';
    std::vector<ScoreSummary> sets;
    for (const auto& [set, scores] : method.scores) {
      sets.push_back(evaluation::summarize(scores));
      text << ' ' << set << ' ' << std::setprecision(3) << sets.back().pq;
    }
    if (!sets.empty())
      text << " mean " << evaluation::meanOfSets(sets).pq;
    text << std::setprecision(1) << " ms " << medianOf(method.milliseconds) << '\n';
  }
  return text.str();
}

} // namespace pcl_mrf_planes::benchmarks
