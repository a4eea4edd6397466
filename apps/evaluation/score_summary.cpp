// SPDX-License-Identifier: BSD-3-Clause
#include "score_summary.h"

#include <cmath>

namespace pcl_mrf_planes::evaluation {

namespace {

ScoreSummary ofFrame(const SegmentationScore& score)
{
  const RegionCounts& counts = score.counts;
  ScoreSummary frame;
  frame.frames = 1;
  frame.truth = counts.truth;
  frame.correct = counts.correct;
  frame.over = counts.over;
  frame.under = counts.under;
  frame.missed = counts.missed;
  frame.noise = counts.noise;
  frame.pq = score.pq;
  frame.sc = score.sc;
  frame.ri = score.ri;
  frame.voi = score.voi;
  frame.recall = score.recall;
  frame.clutter = score.clutter;
  return frame;
}

} // namespace

const std::vector<ScoreColumn>& scoreColumns()
{
  using S = ScoreSummary;
  static const std::vector<ScoreColumn> columns = {
      {"ratio", &S::ratio},    {"truth", &S::truth}, {"correct", &S::correct},
      {"over", &S::over},      {"under", &S::under}, {"missed", &S::missed},
      {"noise", &S::noise},    {"pq", &S::pq},       {"sc", &S::sc},
      {"ri", &S::ri},          {"voi", &S::voi},     {"recall", &S::recall},
      {"clutter", &S::clutter}};
  return columns;
}

ScoreSummary meanOfSets(const std::vector<ScoreSummary>& sets)
{
  ScoreSummary mean;
  for (const ScoreSummary& set : sets)
    mean.frames += set.frames;
  for (const ScoreColumn& column : scoreColumns()) {
    double sum = 0.0;
    int count = 0;
    for (const ScoreSummary& set : sets)
      if (!std::isnan(set.*column.value)) {
        sum += set.*column.value;
        ++count;
      }
    if (count > 0)
      mean.*column.value = sum / count;
  }
  return mean;
}

ScoreSummary summarize(const std::vector<SegmentationScore>& scores)
{
  std::vector<ScoreSummary> frames;
  int correct = 0;
  int truth = 0;
  for (const SegmentationScore& score : scores) {
    frames.push_back(ofFrame(score));
    correct += score.counts.correct;
    truth += score.counts.truth;
  }
  ScoreSummary summary = meanOfSets(frames);
  if (truth > 0)
    summary.ratio = static_cast<double>(correct) / truth;
  return summary;
}

} // namespace pcl_mrf_planes::evaluation
