// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/candidate_energy.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace pcl_mrf_planes::adaptive::reference {

/** \brief Labels, data costs and prices of label changes of every site of a grid. */
struct PottsGrid {
  int width = 0;
  int height = 0;
  std::vector<std::size_t> first = {
      0};                          ///< where a site's labels are; one more than sites
  std::vector<int> label;          ///< by site
  std::vector<double> cost;        ///< of each label
  std::vector<double> right, down; ///< by site; 0 at the borders

  int at(int x, int y) const { return y * width + x; }
  std::size_t labels(int site) const { return end(site) - begin(site); }
  std::size_t begin(int site) const { return first[static_cast<std::size_t>(site)]; }
  std::size_t end(int site) const { return first[static_cast<std::size_t>(site) + 1]; }
};

/** \brief The same problem as a field. Settled blocks have one label that costs nothing,
 * and points that were not measured cost nothing and have no edges. */
inline PottsGrid toPottsGrid(const CandidateField& field)
{
  PottsGrid grid;
  grid.width = field.width;
  grid.height = field.height;
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x) {
      const std::size_t block = blockOf(field, x, y);
      for (std::size_t s = 0; s < field.blocks.count[block]; ++s) {
        grid.label.push_back(field.blocks.labelsOf(block)[s]);
        grid.cost.push_back(
            static_cast<double>(dataCost(field, x, y, grid.label.back())));
      }
      grid.first.push_back(grid.label.size());
      const bool has_right = x + 1 < field.width;
      const bool has_down = y + 1 < field.height;
      grid.right.push_back(has_right ? static_cast<double>(rightEdge(field, x, y)) : 0);
      grid.down.push_back(has_down ? static_cast<double>(downEdge(field, x, y)) : 0);
    }
  return grid;
}

/** \brief Least energy of a narrow grid by dynamic programming over its rows: for every
 * labelling of a row the least energy down to it. O(height * labels^(2 width)) */
class NarrowGridMinimum {
public:
  explicit NarrowGridMinimum(const PottsGrid& grid)
  : grid_(grid)
  {}

  double energy() const
  {
    std::vector<Row> rows = rowsOf(0);
    for (Row& row : rows)
      row.energy = within(row, 0);
    for (int y = 1; y < grid_.height; ++y) {
      std::vector<Row> next = rowsOf(y);
      for (Row& row : next) {
        row.energy = std::numeric_limits<double>::infinity();
        for (const Row& above : rows)
          row.energy = std::min(row.energy, above.energy + between(above, row, y - 1));
        row.energy += within(row, y);
      }
      rows = next;
    }
    return std::min_element(
               rows.begin(), rows.end(),
               [](const Row& a, const Row& b) { return a.energy < b.energy; })
        ->energy;
  }

private:
  /// A labelling of a row.
  struct Row {
    std::vector<std::size_t> chosen; ///< by column: index into label and cost
    double energy = 0.0;             ///< least one with this row as the last
  };

  std::vector<Row> rowsOf(int y) const
  {
    std::vector<Row> rows = {Row()};
    for (int x = 0; x < grid_.width; ++x) {
      std::vector<Row> longer;
      for (const Row& row : rows)
        for (std::size_t k = grid_.begin(grid_.at(x, y)); k < grid_.end(grid_.at(x, y));
             ++k) {
          longer.push_back(row);
          longer.back().chosen.push_back(k);
        }
      rows = longer;
    }
    return rows;
  }

  double within(const Row& row, int y) const
  {
    double sum = 0.0;
    for (std::size_t x = 0; x < row.chosen.size(); ++x) {
      sum += grid_.cost[row.chosen[x]];
      if (x > 0 && grid_.label[row.chosen[x - 1]] != grid_.label[row.chosen[x]])
        sum +=
            grid_.right[static_cast<std::size_t>(grid_.at(static_cast<int>(x) - 1, y))];
    }
    return sum;
  }

  double between(const Row& above, const Row& below, int y) const
  {
    double sum = 0.0;
    for (std::size_t x = 0; x < above.chosen.size(); ++x)
      if (grid_.label[above.chosen[x]] != grid_.label[below.chosen[x]])
        sum += grid_.down[static_cast<std::size_t>(grid_.at(static_cast<int>(x), y))];
    return sum;
  }

  const PottsGrid& grid_;
};

} // namespace pcl_mrf_planes::adaptive::reference
