// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_table.h"

#include "option_values.h"
#include "text_cells.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::evaluation {

namespace {

constexpr std::size_t LEAST_WIDTH = 8; // of a column of numbers
constexpr double MILLIMETRES = 1e3;    // of a metre

/// Collects lines of cells and prints them in columns as wide as they need.
class Table {
public:
  explicit Table(std::vector<std::string> header)
  {
    lines_.push_back(std::move(header));
  }
  void line(const std::string& title) { lines_.push_back({title}); }
  void number(double value, int decimals = 3)
  {
    lines_.back().push_back(std::isnan(value) ? "-" : apps::fixed(value, decimals));
  }
  void print(std::ostream& out) const
  {
    for (const auto& line : lines_) {
      out << line[0] << std::string(width(0) - line[0].size(), ' ');
      for (std::size_t i = 1; i < line.size(); ++i)
        out << ' ' << apps::cell(line[i], std::max(LEAST_WIDTH, width(i)));
      out << '\n';
    }
  }

private:
  /// Of the widest cell of a column.
  std::size_t width(std::size_t column) const
  {
    std::size_t widest = 0;
    for (const auto& line : lines_)
      widest = std::max(widest, line[column].size());
    return widest;
  }

  std::vector<std::vector<std::string>> lines_;
};

void printScores(std::ostream& out, const std::vector<ResultRow>& rows)
{
  std::vector<std::string> header = {"", "frames"};
  for (const ScoreColumn& column : scoreColumns())
    header.push_back(column.name);
  Table table(header);
  for (const ResultRow& row : rows) {
    table.line(row.title());
    table.number(row.scores.frames, 0);
    for (const ScoreColumn& column : scoreColumns())
      table.number(row.scores.*column.value);
  }
  table.print(out);
}

void printBorders(std::ostream& out, const std::vector<ResultRow>& rows)
{
  Table table({"borders", "points", "precision", "recall", "f"});
  for (const ResultRow& row : rows)
    for (const BorderSummary& border : row.borders) {
      table.line(row.title());
      table.number(border.distance, 0);
      table.number(border.precision);
      table.number(border.recall);
      table.number(border.f);
    }
  table.print(out);
}

void printPlaneErrors(std::ostream& out, const std::vector<ResultRow>& rows)
{
  Table table({"planes that match", "planes", "mean deg", "median", "most", "mean mm",
               "median", "most"});
  for (const ResultRow& row : rows) {
    table.line(row.title());
    table.number(row.planes.planes, 0);
    for (const double angle :
         {row.planes.angle.mean, row.planes.angle.median, row.planes.angle.most})
      table.number(angle);
    for (const double offset :
         {row.planes.offset.mean, row.planes.offset.median, row.planes.offset.most})
      table.number(MILLIMETRES * offset, 2);
  }
  table.print(out);
}

void printCurve(std::ostream& out, const ResultRow& all)
{
  Table table({"tolerance", "ratio", "correct", "over", "under", "missed", "noise"});
  for (const CurvePoint& point : all.curve) {
    const RegionCounts& counts = point.counts;
    table.line(apps::fixed(point.tolerance, 2));
    table.number(counts.truth > 0 ? static_cast<double>(counts.correct) / counts.truth
                                  : ScoreSummary::NONE);
    for (const int count :
         {counts.correct, counts.over, counts.under, counts.missed, counts.noise})
      table.number(count, 0);
  }
  table.print(out);
}

} // namespace

void printEvaluation(std::ostream& out, const EvaluationResult& result,
                     const EvaluationOptions& options)
{
  const std::vector<ResultRow> rows = result.rows(options.each);
  printScores(out, rows);
  if (!options.borders.empty()) {
    out << '\n';
    printBorders(out, rows);
  }
  if (!options.cloud.empty()) {
    out << '\n';
    printPlaneErrors(out, rows);
  }
  if (options.curve) {
    out << '\n';
    printCurve(out, result.all);
  }
  const auto& missing = result.without_labels;
  if (!missing.empty())
    out << '\n'
        << missing.size() << " of " << result.frames.size()
        << " frames have no result and count as empty: " << apps::join(missing) << '\n';
}

} // namespace pcl_mrf_planes::evaluation
