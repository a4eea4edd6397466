// SPDX-License-Identifier: BSD-3-Clause
#include "label_runs.h"
#include "frame_memory.h"
#include "label_runs_kernel.h"
#include "threads.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace pcl_mrf_planes {

std::size_t findOther(std::uint16_t label, const std::uint16_t* labels, std::size_t i,
                      std::size_t end)
{
  constexpr std::size_t AT_ONCE = 4;
  constexpr std::uint64_t FOUR_TIMES = 0x0001000100010001U;
  const std::uint64_t same = FOUR_TIMES * label;
  std::uint64_t four = 0;
  for (; i + AT_ONCE <= end; i += AT_ONCE) {
    std::memcpy(&four, labels + i, sizeof(four));
    if (four != same)
      break;
  }
  while (i < end && labels[i] == label)
    ++i;
  return i;
}

namespace {

/// Finds the runs of one row after another.
class RunFinder {
public:
  RunFinder(const std::vector<std::uint16_t>& labels, std::size_t width,
            std::uint16_t background)
  : labels_(labels)
  , width_(width)
  , background_(background)
  , changes_(width)
  {}

  void addRow(std::size_t row, FrameVector<LabelRun>& runs)
  {
    std::size_t begin = row * width_;
    const std::size_t count = findChanges(&labels_[begin], width_, changes_.data());
    for (std::size_t k = 0; k <= count; ++k) {
      const std::size_t end = row * width_ + (k < count ? changes_[k] : width_);
      if (labels_[begin] != background_)
        runs.push_back({begin, end, labels_[begin]});
      begin = end;
    }
  }

private:
  const std::vector<std::uint16_t>& labels_;
  std::size_t width_;
  std::uint16_t background_;
  FrameVector<std::uint32_t> changes_; ///< of the row at hand
};

} // namespace

LabelRuns findRuns(const std::vector<std::uint16_t>& labels, int width,
                   std::uint16_t background, unsigned int threads)
{
  constexpr std::size_t FEW = 16; // runs of a row, about
  LabelRuns out;
  out.width = static_cast<std::size_t>(width);
  const Bands bands(width > 0 ? static_cast<int>(labels.size() / out.width) : 0);
  out.rows.resize(static_cast<std::size_t>(bands.rows) + 1, 0);
  FrameVector<FrameVector<LabelRun>> parts(static_cast<std::size_t>(bands.count));
  parallelParts(bands.count, threads, [&](int band) {
    FrameVector<LabelRun>& runs = parts[static_cast<std::size_t>(band)];
    RunFinder finder(labels, out.width, background);
    runs.reserve(FEW *
                 static_cast<std::size_t>(bands.begin(band + 1) - bands.begin(band)));
    for (int r = bands.begin(band); r < bands.begin(band + 1); ++r) {
      const auto row = static_cast<std::size_t>(r);
      finder.addRow(row, runs);
      out.rows[row + 1] = runs.size(); // as yet of the band
    }
  });
  FrameVector<std::size_t> first = {0}; // run of each band
  for (const FrameVector<LabelRun>& runs : parts)
    first.push_back(first.back() + runs.size());
  out.runs.resize(first.back());
  parallelParts(bands.count, threads, [&](int band) {
    const auto b = static_cast<std::size_t>(band);
    for (int r = bands.begin(band); r < bands.begin(band + 1); ++r)
      out.rows[static_cast<std::size_t>(r) + 1] += first[b];
    std::copy(parts[b].begin(), parts[b].end(),
              out.runs.begin() + static_cast<std::ptrdiff_t>(first[b]));
  });
  return out;
}

std::size_t countSuccessors(const std::vector<int>& numbers, std::size_t k,
                            std::size_t most)
{
  const std::size_t last = std::min(numbers.size() - k, most) - 1;
  const auto follows = [&](std::size_t n) {
    return numbers[k + n] - numbers[k] == static_cast<int>(n);
  };
  if (follows(last))
    return last + 1;
  std::size_t good = 0; // from here on: does not follow any more before last
  std::size_t step = 1;
  while (good + step < last && follows(good + step)) {
    good += step;
    step *= 2;
  }
  for (; step > 0; step /= 2)
    if (good + step < last && follows(good + step))
      good += step;
  return good + 1;
}

FrameVector<LabelRun> runsOfRegions(const std::vector<PlaneRegion>& regions, int width)
{
  FrameVector<LabelRun> runs;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const std::vector<int>& indices = regions[r].indices;
    int row_end = 0;
    for (std::size_t k = 0; k < indices.size();) {
      if (indices[k] >= row_end)
        row_end = (indices[k] / width + 1) * width;
      const std::size_t count =
          countSuccessors(indices, k, static_cast<std::size_t>(row_end - indices[k]));
      const auto begin = static_cast<std::size_t>(indices[k]);
      runs.push_back({begin, begin + count, static_cast<std::uint16_t>(r + 1)});
      k += count;
    }
  }
  return runs;
}

LabelRuns regionRuns(const std::vector<PlaneRegion>& regions, int width, int height)
{
  const FrameVector<LabelRun> runs = runsOfRegions(regions, width);
  LabelRuns out;
  out.width = static_cast<std::size_t>(width);
  // Counting sort by row.
  FrameVector<std::uint32_t> row_of_run;
  row_of_run.reserve(runs.size());
  out.rows.assign(static_cast<std::size_t>(height) + 2, 0);
  for (const LabelRun& run : runs) {
    row_of_run.push_back(static_cast<std::uint32_t>(run.begin / out.width));
    ++out.rows[row_of_run.back() + 2];
  }
  std::partial_sum(out.rows.begin(), out.rows.end(), out.rows.begin());
  out.runs.resize(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k)
    out.runs[out.rows[row_of_run[k] + 1]++] = runs[k];
  out.rows.pop_back();
  const auto at = [&](std::size_t k) {
    return out.runs.begin() + static_cast<std::ptrdiff_t>(k);
  };
  for (std::size_t row = 0; row + 1 < out.rows.size(); ++row)
    std::sort(at(out.rows[row]), at(out.rows[row + 1]),
              [](const LabelRun& a, const LabelRun& b) { return a.begin < b.begin; });
  return out;
}

void fillRun(const LabelRun& run, std::uint16_t label,
             std::vector<std::uint16_t>& labels)
{
  std::fill(labels.begin() + static_cast<std::ptrdiff_t>(run.begin),
            labels.begin() + static_cast<std::ptrdiff_t>(run.end), label);
}

std::size_t RunRoots::findShortening(std::size_t run)
{
  while (root_[run] != run)
    run = root_[run] = root_[root_[run]];
  return run;
}

void RunRoots::joinWithNextRow(const LabelRuns& image, int row)
{
  forEachOverlap(image, static_cast<std::size_t>(row),
                 [&](std::size_t above, std::size_t below) {
                   if (image.runs[above].label != image.runs[below].label)
                     return;
                   const auto [first, second] =
                       std::minmax({findShortening(above), findShortening(below)});
                   if (first == second)
                     return;
                   root_[second] = first;
                   points_[first] += points_[second];
                 });
}

RunRoots::RunRoots(const LabelRuns& image, unsigned int threads)
: root_(image.runs.size())
, points_(image.runs.size())
{
  // Bands by themselves, then what lies on either side of their borders: the root of a part
  // is its first run in any order.
  const Bands bands(std::max(0, static_cast<int>(image.rows.size()) - 1), 8);
  parallelParts(bands.count, threads, [&](int band) {
    const std::size_t end = image.rows[static_cast<std::size_t>(bands.begin(band + 1))];
    for (std::size_t k = image.rows[static_cast<std::size_t>(bands.begin(band))];
         k < end; ++k) {
      root_[k] = k;
      points_[k] = static_cast<int>(image.runs[k].end - image.runs[k].begin);
    }
    for (int row = bands.begin(band); row + 1 < bands.begin(band + 1); ++row)
      joinWithNextRow(image, row);
  });
  for (int band = 1; band < bands.count; ++band)
    joinWithNextRow(image, bands.begin(band) - 1);
}

RunParts connectRuns(const LabelRuns& image, unsigned int threads)
{
  const RunRoots roots(image, threads);
  RunParts parts;
  for (std::size_t k = 0; k < image.runs.size(); ++k) {
    const LabelRun& run = image.runs[k];
    const std::size_t root = roots.of(k);
    const int part =
        root == k ? static_cast<int>(parts.size.size()) : parts.part_of_run[root];
    if (root == k) {
      parts.size.push_back(roots.points(k));
      parts.first.push_back(run.begin);
      parts.label.push_back(run.label);
    }
    parts.part_of_run.push_back(part);
  }
  return parts;
}

} // namespace pcl_mrf_planes
