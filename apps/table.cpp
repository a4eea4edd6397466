// SPDX-License-Identifier: BSD-3-Clause
#include "table.h"

#include "text_cells.h"

#include <string>

namespace pcl_mrf_planes::apps {

void printPlanes(std::ostream& out, const SegmentedCloud& result)
{
  if (result.planes.empty())
    return;
  out << "plane   points   area m2   rms mm         a         b         c         d\n";
  for (std::size_t k = 0; k < result.planes.size(); ++k) {
    const PlaneSummary& plane = result.planes[k];
    out << cell(std::to_string(k + 1), 5) << cell(std::to_string(plane.points), 9)
        << cell(fixed(plane.area, 4), 10) << cell(fixed(1e3 * plane.rms, 2), 9);
    for (int i = 0; i < 4; ++i)
      out << cell(fixed(static_cast<double>(plane.coefficients[i]), 5), 10);
    out << '\n';
  }
}

void printTiming(std::ostream& out, const Timing& timing)
{
  out << cell("stage", 12) << cell("median ms", 12) << cell("least", 12)
      << cell("most", 12) << '\n';
  const auto line = [&](const std::string& name, const Spread& spread) {
    out << cell(name, 12) << cell(fixed(spread.median, 3), 12)
        << cell(fixed(spread.least, 3), 12) << cell(fixed(spread.most, 3), 12) << '\n';
  };
  for (const auto& stage : timing.stages())
    line(stage.first, stage.second);
  line("total", timing.total());
}

namespace {

/// What to try where no plane was found.
const char* advice(std::size_t tiles_kept, const Parameters& parameters)
{
  const bool paper = parameters.method == Method::PAPER;
  if (tiles_kept == 0)
    return paper ? "; try another --noise (none keeps every tile) or smaller tiles"
                 : "; try a larger --tile-tolerance or a smaller --min-fill";
  return paper ? "; try a smaller --min-inliers"
               : "; try a smaller --min-evidence, --min-points or --min-inliers";
}

} // namespace

void printSummary(std::ostream& out, const SegmentedCloud& result,
                  const Parameters& parameters)
{
  const SegmentationReport& report = result.report;
  const std::size_t planes = result.planes.size();
  out << (planes == 0 ? std::string("no plane found") : std::to_string(planes))
      << (planes == 0   ? ""
          : planes == 1 ? " plane"
                        : " planes")
      << " on " << fixed(100.0 * report.labelled_share, 1) << " % of "
      << std::to_string(report.valid_points) << " valid points ("
      << std::to_string(result.labels.width) << " x "
      << std::to_string(result.labels.height) << "), "
      << std::to_string(report.tiles_kept) << " of "
      << std::to_string(report.tiles_tried) << " tiles kept, "
      << fixed(result.timing.total().median, 1) << " ms";
  if (planes == 0)
    out << advice(report.tiles_kept, parameters);
  out << '\n';
}

} // namespace pcl_mrf_planes::apps
