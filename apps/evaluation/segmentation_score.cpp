// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation_score.h"

#include "region_matching.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_mrf_planes::evaluation {

namespace {

double ratio(std::int64_t part, std::int64_t whole)
{
  return static_cast<double>(part) / static_cast<double>(whole);
}

double panopticQuality(const ContingencyTable& table,
                       const std::vector<RegionOverlap>& overlaps, int min_points)
{
  double sum = 0.0;
  int matches = 0;
  std::vector<char> matched(table.labels.size(), 0);
  for (const RegionOverlap& overlap : overlaps)
    if (overlap.isMatch()) {
      sum += overlap.iou;
      ++matches;
      matched[overlap.label] = 1;
    }
  const int missed = table.countTruePlanes(min_points) - matches;
  int wrong = 0;
  for (std::size_t j = 0; j < table.labels.size(); ++j) {
    const auto& region = table.labels[j];
    const bool judged = region.isPlane() && region.points > min_points &&
                        2 * region.on_no_plane < region.points;
    wrong += judged && matched[j] == 0 ? 1 : 0;
  }
  return matches + wrong + missed > 0 ? sum / (matches + 0.5 * wrong + 0.5 * missed)
                                      : 1.0;
}

double covering(const ContingencyTable& table,
                const std::vector<RegionOverlap>& overlaps, int min_points)
{
  std::vector<double> best(table.truth.size(), 0.0);
  for (const RegionOverlap& overlap : overlaps)
    best[overlap.truth] = std::max(best[overlap.truth], overlap.iou);
  double sum = 0.0;
  std::int64_t points = 0;
  for (std::size_t i = 0; i < table.truth.size(); ++i)
    if (table.truth[i].isPlane() && table.truth[i].points > min_points) {
      sum += best[i] * static_cast<double>(table.truth[i].points);
      points += table.truth[i].points;
    }
  return points > 0 ? sum / static_cast<double>(points) : 1.0;
}

/// Pairs of points and entropy of a partition, added up part by part.
class Partition {
public:
  explicit Partition(std::int64_t points)
  : points_(points)
  {}
  void add(std::int64_t part)
  {
    if (part == 0)
      return;
    const double share = ratio(part, points_);
    pairs_ += static_cast<double>(part) * static_cast<double>(part - 1) / 2.0;
    entropy_ -= share * std::log(share);
  }
  double pairs() const { return pairs_; }
  double entropy() const { return entropy_; } // nats

private:
  std::int64_t points_;
  double pairs_ = 0.0;
  double entropy_ = 0.0;
};

/// Rand index and variation of information, over the points on a true plane.
void comparePartitions(const ContingencyTable& table, std::int64_t on_planes,
                       SegmentationScore& score)
{
  Partition truth(on_planes), labels(on_planes), both(on_planes);
  for (const auto& region : table.truth)
    if (region.isPlane())
      truth.add(region.points);
  for (const auto& region : table.labels)
    labels.add(region.points - region.on_no_plane);
  for (const auto& cell : table.cells)
    if (table.truth[cell.truth].isPlane())
      both.add(cell.points);
  Partition all(on_planes);
  all.add(on_planes);
  score.ri =
      on_planes > 1
          ? 1.0 - (truth.pairs() + labels.pairs() - 2.0 * both.pairs()) / all.pairs()
          : 1.0;
  score.voi = 2.0 * both.entropy() - truth.entropy() - labels.entropy();
}

/// Points on true planes and off them, and those of each that carry a plane.
struct Coverage {
  std::int64_t on = 0, off = 0, on_labelled = 0, off_labelled = 0;

  explicit Coverage(const ContingencyTable& table)
  {
    for (const auto& region : table.truth) {
      const std::int64_t labelled = region.points - region.on_no_plane;
      (region.isPlane() ? on : off) += region.points;
      (region.isPlane() ? on_labelled : off_labelled) += labelled;
    }
  }
};

} // namespace

SegmentationScore scoreTable(const ContingencyTable& table, const ScoreOptions& options)
{
  SegmentationScore score;
  score.counts = countRegions(table, options.tolerance, options.min_points);
  const auto overlaps = planeOverlaps(table, options.min_points);
  score.pq = panopticQuality(table, overlaps, options.min_points);
  score.sc = covering(table, overlaps, options.min_points);
  const Coverage coverage(table);
  if (coverage.on > 0) {
    comparePartitions(table, coverage.on, score);
    score.recall = ratio(coverage.on_labelled, coverage.on);
  }
  if (options.complete && coverage.off > 0)
    score.clutter = ratio(coverage.off_labelled, coverage.off);
  return score;
}

SegmentationScore scoreLabels(const LabelImage& truth, const LabelImage& labels,
                              const ScoreOptions& options)
{
  return scoreTable(compareLabels(truth, labels), options);
}

} // namespace pcl_mrf_planes::evaluation
