// SPDX-License-Identifier: BSD-3-Clause
#include "region_counts.h"

#include <algorithm>
#include <stdexcept>

namespace pcl_mrf_planes::evaluation {

namespace {

using Cell = ContingencyTable::Cell;
using Region = ContingencyTable::Region;

/// Classes of the regions as they are given, one step for each class.
class Classification {
public:
  Classification(const ContingencyTable& table, double tolerance, int min_points)
  : table_(table)
  , tolerance_(tolerance)
  , true_open_(planes(table.truth, min_points))
  , label_open_(planes(table.labels, min_points))
  {
    for (const Cell& cell : table.cells)
      if (true_open_[cell.truth] != 0 && label_open_[cell.label] != 0)
        cells_.push_back(cell);
    counts_.truth = open(true_open_);
  }

  RegionCounts run()
  {
    findCorrect();
    findOver();
    findUnder();
    counts_.missed = open(true_open_);
    counts_.noise = open(label_open_);
    return counts_;
  }

private:
  using Flags = std::vector<char>;

  static Flags planes(const std::vector<Region>& regions, int min_points)
  {
    Flags flags;
    for (const Region& region : regions)
      flags.push_back(region.isPlane() && region.points > min_points ? 1 : 0);
    return flags;
  }

  static int open(const Flags& flags)
  {
    return static_cast<int>(std::count(flags.begin(), flags.end(), 1));
  }

  bool covers(std::int64_t points, const Region& region) const
  {
    return static_cast<double>(points) >=
           tolerance_ * static_cast<double>(region.points);
  }
  bool coversTruth(const Cell& cell) const
  {
    return covers(cell.points, table_.truth[cell.truth]);
  }
  bool coversLabel(const Cell& cell) const
  {
    return covers(cell.points, table_.labels[cell.label]);
  }

  void findCorrect()
  {
    for (const Cell& cell : cells_)
      if (coversTruth(cell) && coversLabel(cell)) {
        ++counts_.correct;
        true_open_[cell.truth] = 0;
        label_open_[cell.label] = 0;
      }
  }

  /// A true plane of which several regions are parts, which together cover it.
  void findOver()
  {
    forEachGroup(&Cell::truth, [&](auto first, auto last) {
      std::vector<std::size_t> parts;
      std::int64_t points = 0;
      for (auto cell = first; cell != last; ++cell)
        if (label_open_[cell->label] != 0 && coversLabel(*cell)) {
          parts.push_back(cell->label);
          points += cell->points;
        }
      if (true_open_[first->truth] == 0 || parts.size() < 2 ||
          !covers(points, table_.truth[first->truth]))
        return;
      ++counts_.over;
      true_open_[first->truth] = 0;
      for (const std::size_t part : parts)
        label_open_[part] = 0;
    });
  }

  /// A region of which several true planes are parts, which together cover it.
  void findUnder()
  {
    std::stable_sort(cells_.begin(), cells_.end(),
                     [](const Cell& a, const Cell& b) { return a.label < b.label; });
    forEachGroup(&Cell::label, [&](auto first, auto last) {
      std::vector<std::size_t> parts;
      std::int64_t points = 0;
      for (auto cell = first; cell != last; ++cell)
        if (true_open_[cell->truth] != 0 && coversTruth(*cell)) {
          parts.push_back(cell->truth);
          points += cell->points;
        }
      if (label_open_[first->label] == 0 || parts.size() < 2 ||
          !covers(points, table_.labels[first->label]))
        return;
      ++counts_.under;
      label_open_[first->label] = 0;
      for (const std::size_t part : parts)
        true_open_[part] = 0;
    });
  }

  /// Neighbouring cells of one region.
  template <typename Visit>
  void forEachGroup(std::size_t Cell::*region, const Visit& visit)
  {
    for (auto first = cells_.begin(); first != cells_.end();) {
      const auto last = std::find_if(first, cells_.end(), [&](const Cell& cell) {
        return cell.*region != (*first).*region;
      });
      visit(first, last);
      first = last;
    }
  }

  const ContingencyTable& table_;
  const double tolerance_;
  Flags true_open_, label_open_; // 1: a plane without a class
  std::vector<Cell> cells_;      // of two planes that count
  RegionCounts counts_;
};

} // namespace

RegionCounts countRegions(const ContingencyTable& table, double tolerance,
                          int min_points)
{
  if (!(tolerance > 0.5 && tolerance <= 1.0))
    throw std::invalid_argument("the tolerance must be above 0.5 and at most 1");
  if (min_points < 0)
    throw std::invalid_argument("the least number of points must not be negative");
  return Classification(table, tolerance, min_points).run();
}

std::vector<double> curveTolerances()
{
  std::vector<double> tolerances = {0.51};
  for (int percent = 55; percent <= 95; percent += 5)
    tolerances.push_back(percent / 100.0);
  return tolerances;
}

std::vector<CurvePoint> toleranceCurve(const ContingencyTable& table, int min_points)
{
  std::vector<CurvePoint> curve;
  for (const double tolerance : curveTolerances())
    curve.push_back({tolerance, countRegions(table, tolerance, min_points)});
  return curve;
}

} // namespace pcl_mrf_planes::evaluation
