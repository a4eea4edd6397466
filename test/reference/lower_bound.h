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

  /// Makes the min-marginals of a site's row and column the same.
  void agree(int site)
  {
    for (std::size_t k = grid_.begin(site); k < grid_.end(site); ++k) {
      std::array<double, 2> marginal;
      for (const Family f : {ROWS, COLUMNS})
        marginal[f] = chains_[f].share[k] + chains_[f].before[k] + chains_[f].after[k];
      const double transfer = (marginal[COLUMNS] - marginal[ROWS]) / 2;
      chains_[ROWS].share[k] += transfer;
      chains_[COLUMNS].share[k] -= transfer;
    }
  }

  /// Messages of a site to the next ones, or to the ones before.
  void tell(int site, bool forwards)
  {
    for (const Family f : {ROWS, COLUMNS}) {
      const int other = neighbour(f, site, forwards);
      if (other < 0)
        continue;
      Chain& chain = chains_[f];
      const std::vector<double>& heard = forwards ? chain.before : chain.after;
      std::vector<double> known(grid_.end(site) - grid_.begin(site));
      for (std::size_t k = 0; k < known.size(); ++k)
        known[k] = chain.share[grid_.begin(site) + k] + heard[grid_.begin(site) + k];
      const double weight =
          (f == ROWS ? grid_.right
                     : grid_.down)[static_cast<std::size_t>(std::min(site, other))];
      const std::vector<double> message = pass(site, known, other, weight);
      std::copy(message.begin(), message.end(),
                (forwards ? chain.before : chain.after).begin() +
                    static_cast<std::ptrdiff_t>(grid_.begin(other)));
    }
  }

  /// Site before or after in the chain; -1: none.
  int neighbour(Family family, int site, bool forwards) const
  {
    const int step = (family == ROWS ? 1 : grid_.width) * (forwards ? 1 : -1);
    if (family == ROWS) {
      const int x = site % grid_.width + step;
      return x < 0 || x >= grid_.width ? -1 : site + step;
    }
    const int other = site + step;
    return other < 0 || other >= grid_.width * grid_.height ? -1 : other;
  }

  /// For each label of a site the least of what is known of another: of the same label,
  /// or of any at the price of a change.
  std::vector<double> pass(int from, const std::vector<double>& known, int to,
                           double weight) const
  {
    const double least = *std::min_element(known.begin(), known.end());
    std::vector<double> message;
    for (std::size_t k = grid_.begin(to); k < grid_.end(to); ++k) {
      double best = least + weight;
      for (std::size_t j = 0; j < known.size(); ++j)
        if (grid_.label[grid_.begin(from) + j] == grid_.label[k])
          best = std::min(best, known[j]);
      message.push_back(best);
    }
    return message;
  }

  double leastOfChain(Family family, int start, int step, int length) const
  {
    const auto shareOf = [&](int site) {
      const auto begin = chains_[family].share.begin();
      return std::vector<double>(begin + static_cast<std::ptrdiff_t>(grid_.begin(site)),
                                 begin + static_cast<std::ptrdiff_t>(grid_.end(site)));
    };
    std::vector<double> best = shareOf(start);
    for (int i = 1; i < length; ++i) {
      const int from = start + (i - 1) * step;
      const double weight =
          (family == ROWS ? grid_.right : grid_.down)[static_cast<std::size_t>(from)];
      const std::vector<double> message = pass(from, best, from + step, weight);
      best = shareOf(from + step);
      for (std::size_t k = 0; k < best.size(); ++k)
        best[k] += message[k];
    }
    return *std::min_element(best.begin(), best.end());
  }

  const PottsGrid& grid_;
  std::array<Chain, 2> chains_;
};

} // namespace pcl_mrf_planes::adaptive::reference
