// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_result.h"

#include "label_file.h"

#include <cmath>
#include <stdexcept>

namespace pcl_mrf_planes::evaluation {

namespace {

/// Mean of the values that are there.
class Mean {
public:
  void add(double value)
  {
    if (std::isnan(value))
      return;
    sum_ += value;
    ++count_;
  }
  double get() const { return count_ > 0 ? sum_ / count_ : ScoreSummary::NONE; }

private:
  double sum_ = 0.0;
  int count_ = 0;
};

using Frames = std::vector<const FrameResult*>;

BorderSummary meanBorder(const std::vector<BorderSummary>& parts)
{
  Mean precision, recall, f;
  for (const BorderSummary& part : parts) {
    precision.add(part.precision);
    recall.add(part.recall);
    f.add(part.f);
  }
  return {parts[0].distance, precision.get(), recall.get(), f.get()};
}

std::vector<BorderSummary> meanBorders(const Frames& frames)
{
  std::vector<BorderSummary> means;
  for (std::size_t k = 0; k < frames[0]->borders.size(); ++k) {
    std::vector<BorderSummary> parts;
    for (const FrameResult* frame : frames) {
      const BorderAgreement& border = frame->borders[k];
      parts.push_back(
          {border.distance, border.precision(), border.recall(), border.f()});
    }
    means.push_back(meanBorder(parts));
  }
  return means;
}

void add(const RegionCounts& part, RegionCounts& sum)
{
  for (int RegionCounts::*count :
       {&RegionCounts::truth, &RegionCounts::correct, &RegionCounts::over,
        &RegionCounts::under, &RegionCounts::missed, &RegionCounts::noise})
    sum.*count += part.*count;
}

std::vector<CurvePoint> sumCurves(const Frames& frames)
{
  std::vector<CurvePoint> sum;
  for (std::size_t k = 0; k < frames[0]->curve.size(); ++k) {
    sum.push_back({frames[0]->curve[k].tolerance, {}});
    for (const FrameResult* frame : frames)
      add(frame->curve[k].counts, sum[k].counts);
  }
  return sum;
}

ResultRow makeRow(const std::string& kind, const Frames& frames)
{
  ResultRow row;
  row.kind = kind;
  std::vector<SegmentationScore> scores;
  std::vector<PlaneError> planes;
  for (const FrameResult* frame : frames) {
    scores.push_back(frame->score);
    planes.insert(planes.end(), frame->planes.begin(), frame->planes.end());
  }
  row.scores = summarize(scores);
  row.borders = meanBorders(frames);
  row.planes = summarize(planes);
  row.curve = sumCurves(frames);
  return row;
}

/// Mean of the sets' means and medians; the largest error of all stays the largest.
ErrorSpread meanSpread(const std::vector<ResultRow>& sets, const ResultRow& all,
                       ErrorSpread PlaneErrorSummary::*spread)
{
  Mean mean, median;
  for (const ResultRow& set : sets) {
    mean.add((set.planes.*spread).mean);
    median.add((set.planes.*spread).median);
  }
  return {mean.get(), median.get(), (all.planes.*spread).most};
}

ResultRow meanRow(const std::vector<ResultRow>& sets, const ResultRow& all)
{
  ResultRow row;
  row.kind = "mean of sets";
  std::vector<ScoreSummary> scores;
  scores.reserve(sets.size());
  for (const ResultRow& set : sets)
    scores.push_back(set.scores);
  row.scores = meanOfSets(scores);
  for (std::size_t k = 0; k < all.borders.size(); ++k) {
    std::vector<BorderSummary> parts;
    parts.reserve(sets.size());
    for (const ResultRow& set : sets)
      parts.push_back(set.borders[k]);
    row.borders.push_back(meanBorder(parts));
  }
  row.planes = {all.planes.planes, meanSpread(sets, all, &PlaneErrorSummary::angle),
                meanSpread(sets, all, &PlaneErrorSummary::offset)};
  return row;
}

/// Images or points that have no partner are a matter of the files.
template <typename Work>
auto aboutPair(const FrameFiles& files, const std::string& other, const Work& work)
{
  try {
    return work();
  }
  catch (const std::invalid_argument& error) {
    throw std::runtime_error("'" + other + "' does not belong to '" + files.truth +
                             "': " + error.what() + "; give files of one frame");
  }
}

} // namespace

std::string ResultRow::title() const
{
  if (kind == "frame")
    return set.empty() ? name : set + "/" + name;
  return kind == "set" ? (set.empty() ? "." : set) : kind;
}

std::vector<ResultRow> EvaluationResult::rows(bool with_frames) const
{
  std::vector<ResultRow> result;
  if (with_frames)
    result = frame_rows;
  result.insert(result.end(), set_rows.begin(), set_rows.end());
  if (mean_of_sets)
    result.push_back(*mean_of_sets);
  result.push_back(all);
  return result;
}

FrameResult scoreFrame(const FrameFiles& files, const EvaluationOptions& options)
{
  const LabelImage truth = readLabels(files.truth);
  LabelImage labels;
  if (files.labels.empty())
    labels = {truth.width, truth.height,
              std::vector<std::uint16_t>(truth.size(), std::uint16_t{0})};
  else
    labels = readLabels(files.labels);
  FrameResult result;
  result.files = files;
  const ContingencyTable table =
      aboutPair(files, files.labels, [&] { return compareLabels(truth, labels); });
  result.score = scoreTable(table, options.score);
  if (options.curve)
    result.curve = toleranceCurve(table, options.score.min_points);
  for (const int distance : options.borders)
    result.borders.push_back(compareBorders(truth, labels, distance));
  if (!files.cloud.empty()) {
    const OrganizedPoints points = readPoints(files.cloud);
    result.planes = aboutPair(files, files.cloud, [&] {
      return planeErrors(points, truth, labels, options.score.min_points);
    });
  }
  return result;
}

EvaluationResult summarizeFrames(std::vector<FrameResult> frames)
{
  EvaluationResult result;
  result.frames = std::move(frames);
  Frames all, set;
  bool has_sets = false;
  for (std::size_t i = 0; i < result.frames.size(); ++i) {
    const FrameResult& frame = result.frames[i];
    ResultRow row = makeRow("frame", {&frame});
    row.set = frame.files.set;
    row.name = frame.files.name;
    row.has_labels = !frame.files.labels.empty();
    if (!row.has_labels)
      result.without_labels.push_back(row.title());
    result.frame_rows.push_back(row);
    has_sets = has_sets || !frame.files.set.empty();
    all.push_back(&frame);
    set.push_back(&frame);
    if (i + 1 < result.frames.size() &&
        result.frames[i + 1].files.set == frame.files.set)
      continue;
    result.set_rows.push_back(makeRow("set", set));
    result.set_rows.back().set = frame.files.set;
    set.clear();
  }
  result.all = makeRow("all frames", all);
  if (has_sets)
    result.mean_of_sets = meanRow(result.set_rows, result.all);
  else
    result.set_rows.clear();
  return result;
}

} // namespace pcl_mrf_planes::evaluation
