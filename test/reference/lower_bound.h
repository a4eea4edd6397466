// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/potts_grid.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::adaptive::reference {

/** \brief Lower bound on the energy of a grid by dual decomposition into chains.
 *
 * The data costs are split between the rows and the columns of the grid, half and half at
 * first. However they are split, the least energy of every row and of every column by
 * itself, added up, is never above the least energy of the grid: there rows and columns
 * have to agree on labels, here not. The ascent moves costs between the two at one site
 * after the other, such that both see the same min-marginals there, which can only raise
 * the sum (Kolmogorov, "Convergent Tree-Reweighted Message Passing for Energy
 * Minimization", PAMI 2006). O(sites * labels) an iteration.
 */
class LowerBound {
public:
  explicit LowerBound(const PottsGrid& grid)
  : grid_(grid)
  {
    for (Chain& chain : chains_) {
      chain.share = grid.cost;
      for (double& cost : chain.share)
        cost /= 2;
      chain.before.assign(grid.cost.size(), 0.0);
      chain.after.assign(grid.cost.size(), 0.0);
    }
  }

  /** \brief Through the image and back again. */
  void iterate()
  {
    const int sites = grid_.width * grid_.height;
    for (int i = 0; i < sites; ++i) {
      agree(i);
      tell(i, true);
    }
    for (int i = sites - 1; i >= 0; --i) {
      agree(i);
      tell(i, false);
    }
  }

  /** \brief The bound, by dynamic programming over each chain from the costs alone. */
  double bound() const
  {
    double sum = 0.0;
    for (int y = 0; y < grid_.height; ++y)
      sum += leastOfChain(ROWS, grid_.at(0, y), 1, grid_.width);
    for (int x = 0; x < grid_.width; ++x)
      sum += leastOfChain(COLUMNS, grid_.at(x, 0), grid_.width, grid_.height);
    return sum;
  }

private:
  enum Family : std::size_t { ROWS, COLUMNS };

  /// One family of chains: its part of the data costs and the messages within it.
  struct Chain {
    std::vector<double> share, before, after;
  };

  /// A number for each label of a site; more are not in use.
  using Costs = std::array<double, CandidateBlocks::SLOTS>;

  /// Makes the min-marginals of a site's row and column the same.
  void agree(int site)
  {
    Chain& row = chains_[ROWS];
    Chain& column = chains_[COLUMNS];
    for (std::size_t k = grid_.begin(site); k < grid_.end(site); ++k) {
      const double in_row = row.share[k] + row.before[k] + row.after[k];
      const double in_column = column.share[k] + column.before[k] + column.after[k];
      row.share[k] += (in_column - in_row) / 2;
      column.share[k] -= (in_column - in_row) / 2;
    }
  }

  /// Messages of a site to the next ones, or to the ones before.
  void tell(int site, bool forwards)
  {
    for (const Family f : {ROWS, COLUMNS}) {
      const int other = neighbour(f, site, forwards);
      // Between two sites without a choice there is nothing to say.
      if (other < 0 || (grid_.labels(site) == 1 && grid_.labels(other) == 1))
        continue;
      Chain& chain = chains_[f];
      std::vector<double>& messages = forwards ? chain.before : chain.after;
      Costs known = {};
      for (std::size_t k = 0; k < grid_.labels(site); ++k)
        known[k] = chain.share[grid_.begin(site) + k] + messages[grid_.begin(site) + k];
      const Costs message = pass(f, site, known, other);
      std::copy_n(message.begin(), grid_.labels(other), &messages[grid_.begin(other)]);
    }
  }

  /// Site before or after in the chain; -1: none.
  int neighbour(Family family, int site, bool forwards) const
  {
    const int x = site % grid_.width + (forwards ? 1 : -1);
    if (family == ROWS)
      return x < 0 || x >= grid_.width ? -1 : site + (forwards ? 1 : -1);
    const int other = site + (forwards ? grid_.width : -grid_.width);
    return other < 0 || other >= grid_.width * grid_.height ? -1 : other;
  }

  /// For each label of a site the least of what is known of another: of the same label,
  /// or of any at the price of a change.
  Costs pass(Family family, int from, const Costs& known, int to) const
  {
    const std::size_t count = grid_.labels(from);
    const double weight =
        (family == ROWS ? grid_.right
                        : grid_.down)[static_cast<std::size_t>(std::min(from, to))];
    const double least = *std::min_element(
        known.begin(), known.begin() + static_cast<std::ptrdiff_t>(count));
    Costs message = {};
    for (std::size_t k = 0; k < grid_.labels(to); ++k) {
      message[k] = least + weight;
      for (std::size_t j = 0; j < count; ++j)
        if (grid_.label[grid_.begin(from) + j] == grid_.label[grid_.begin(to) + k])
          message[k] = std::min(message[k], known[j]);
    }
    return message;
  }

  double leastOfChain(Family family, int start, int step, int length) const
  {
    Costs best = {}; // with this label at the site, of all before it
    for (int i = 0; i < length; ++i) {
      const int site = start + i * step;
      if (i > 0)
        best = pass(family, site - step, best, site);
      for (std::size_t k = 0; k < grid_.labels(site); ++k)
        best[k] += chains_[family].share[grid_.begin(site) + k];
    }
    const int last = start + (length - 1) * step;
    return *std::min_element(
        best.begin(), best.begin() + static_cast<std::ptrdiff_t>(grid_.labels(last)));
  }

  const PottsGrid& grid_;
  std::array<Chain, 2> chains_;
};

} // namespace pcl_mrf_planes::adaptive::reference
