// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frame_memory.h"
#include "threads.h"

#include <pcl_mrf_planes/plane_regions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/// Neighbouring points of a row that carry the same label.
struct LabelRun {
  std::size_t begin; ///< index of the first point
  std::size_t end;   ///< one past the last
  std::uint16_t label;
};

/// The runs of a label image, without those of the background. An image has some thousands
/// of them, so that what is done run by run costs little.
struct LabelRuns {
  std::size_t width = 0;         ///< of the image
  FrameVector<LabelRun> runs;    ///< row by row
  FrameVector<std::size_t> rows; ///< first run of each row, and the end of the last row
};

/// Calls visit(k) for the number of every run, as parallelRows() does for rows.
template <typename Visit>
void forEachRun(const LabelRuns& image, unsigned int threads, const Visit& visit)
{
  parallelRows(static_cast<int>(image.rows.size()) - 1, threads, [&](int row) {
    const auto r = static_cast<std::size_t>(row);
    for (std::size_t k = image.rows[r]; k < image.rows[r + 1]; ++k)
      visit(k);
  });
}

/// The first point from i on whose label is another one, or end. Four labels are compared at
/// once.
std::size_t findOther(std::uint16_t label, const std::uint16_t* labels, std::size_t i,
                      std::size_t end);

/// Runs of a label image. \param[in] background label that belongs to no run
/// O(points)
LabelRuns findRuns(const std::vector<std::uint16_t>& labels, int width,
                   std::uint16_t background, unsigned int threads = 1);

/// How many numbers follow each other, one more each time, from the k-th on; at most so many.
/// Numbers ascend. O(log of the result)
std::size_t countSuccessors(const std::vector<int>& numbers, std::size_t k,
                            std::size_t most);

/// Runs of regions, whose points ascend, region by region; the label is the region's number,
/// from 1. O(runs log points)
FrameVector<LabelRun> runsOfRegions(const std::vector<PlaneRegion>& regions, int width);

/// The same row by row.
LabelRuns regionRuns(const std::vector<PlaneRegion>& regions, int width, int height);

/// Writes one label over all points of a run.
void fillRun(const LabelRun& run, std::uint16_t label,
             std::vector<std::uint16_t>& labels);

/// Runs of the same label that lie above one another, joined: each 4-connected part has one
/// root, its first run in the image.
class RunRoots {
public:
  /// O(runs)
  explicit RunRoots(const LabelRuns& image, unsigned int threads = 1);

  /// The root of a run, never one after it. Any number of threads may ask.
  std::size_t of(std::size_t run) const
  {
    while (root_[run] != run)
      run = root_[run];
    return run;
  }

  /// Points of the part that a run belongs to.
  int points(std::size_t run) const { return points_[of(run)]; }

private:
  void joinWithNextRow(const LabelRuns& image, int row);
  std::size_t findShortening(std::size_t run);

  FrameVector<std::size_t> root_; ///< of each run, or one on the way to it
  FrameVector<int> points_;       ///< of each root's part
};

/// 4-connected parts of a label image, in the order of their first points.
struct RunParts {
  FrameVector<int> part_of_run;
  FrameVector<int> size;          ///< points of each part
  FrameVector<std::size_t> first; ///< first point of each part
  FrameVector<std::uint16_t> label;
};

/// The parts of all runs. O(runs)
RunParts connectRuns(const LabelRuns& image, unsigned int threads = 1);

/// Calls overlap(a, b) for each run a of a row and each b of the next row that have a
/// column in common, from left to right; of any labels.
template <typename Overlap>
void forEachOverlap(const LabelRuns& image, std::size_t row, const Overlap& overlap)
{
  const FrameVector<LabelRun>& runs = image.runs;
  std::size_t a = image.rows[row];
  std::size_t b = image.rows[row + 1];
  const std::size_t a_last = image.rows[row + 1];
  const std::size_t b_last = image.rows[row + 2];
  while (a < a_last && b < b_last) {
    const std::size_t a_begin = runs[a].begin + image.width;
    const std::size_t a_end = runs[a].end + image.width;
    if (a_begin < runs[b].end && runs[b].begin < a_end)
      overlap(a, b);
    if (a_end <= runs[b].end)
      ++a;
    else
      ++b;
  }
}

} // namespace pcl_mrf_planes
