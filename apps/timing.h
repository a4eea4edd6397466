// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief Middle and spread of several measurements, milliseconds. */
struct Spread {
  double median = 0.0;
  double least = 0.0;
  double most = 0.0;
};

/** \brief Median (the mean of the middle two of an even number), least and most. */
Spread spreadOf(std::vector<double> measurements);

/** \brief Times of repeated runs, by stage. */
class Timing {
public:
  /** \brief Add the stages of a run, which are the same in every run. */
  void add(const std::vector<std::pair<std::string, double>>& stage_ms);

  std::size_t runs() const { return totals_.size(); }
  Spread total() const { return spreadOf(totals_); }
  std::vector<std::pair<std::string, Spread>> stages() const;

private:
  std::vector<double> totals_;
  std::vector<std::pair<std::string, std::vector<double>>> stages_;
};

} // namespace pcl_mrf_planes::apps
