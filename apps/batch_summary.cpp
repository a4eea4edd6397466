// SPDX-License-Identifier: BSD-3-Clause
#include "batch_summary.h"

#include "output_file.h"
#include "text_cells.h"
#include "timing.h"

#include <algorithm>

namespace pcl_mrf_planes::apps {

namespace {

using Status = FrameOutcome::Status;

const char* statusName(Status status)
{
  switch (status) {
  case Status::DONE:
    return "done";
  case Status::RESUMED:
    return "there before";
  case Status::FAILED:
    return "failed";
  case Status::NOT_REACHED:
    break;
  }
  return "not reached";
}

std::string csvLine(const FrameOutcome& outcome)
{
  const bool has_numbers =
      outcome.status == Status::DONE || outcome.status == Status::RESUMED;
  std::string line = csvText(outcome.name) + ',' + statusName(outcome.status) + ',' +
                     outcome.reader + ',';
  const ReportedFrame& numbers = outcome.numbers;
  line += has_numbers
              ? std::to_string(numbers.planes) + ',' +
                    std::to_string(numbers.valid_points) + ',' +
                    fixed(numbers.labelled_share, 6) + ',' + fixed(numbers.ms, 3)
              : std::string(",,,");
  return line + ',' + csvText(outcome.input) + ',' + csvText(outcome.message) + '\n';
}

/// Middle, least and most of a number of the frames that have it.
void printNumber(std::ostream& out, const char* name,
                 const std::vector<FrameOutcome>& outcomes,
                 double (*number)(const ReportedFrame&), int digits)
{
  std::vector<double> values;
  for (const FrameOutcome& outcome : outcomes)
    if (outcome.status == Status::DONE || outcome.status == Status::RESUMED)
      values.push_back(number(outcome.numbers));
  if (values.empty())
    return;
  const Spread spread = spreadOf(values);
  out << cell(name, 12) << cell(fixed(spread.median, digits), 10)
      << cell(fixed(spread.least, digits), 10) << cell(fixed(spread.most, digits), 10)
      << '\n';
}

} // namespace

std::size_t countOf(const std::vector<FrameOutcome>& outcomes, Status status)
{
  return static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(),
                    [&](const auto& outcome) { return outcome.status == status; }));
}

void writeSummary(const std::string& path, const std::vector<FrameOutcome>& outcomes)
{
  std::string text =
      "frame,status,reader,planes,valid_points,labelled_share,ms,input,message\n";
  for (const FrameOutcome& outcome : outcomes)
    text += csvLine(outcome);
  writeBytes(path, text);
}

void printSummary(std::ostream& out, const std::vector<FrameOutcome>& outcomes,
                  double seconds)
{
  if (outcomes.size() >
      countOf(outcomes, Status::FAILED) + countOf(outcomes, Status::NOT_REACHED)) {
    out << cell("", 12) << cell("median", 10) << cell("least", 10) << cell("most", 10)
        << '\n';
    printNumber(
        out, "planes", outcomes,
        [](const ReportedFrame& f) { return static_cast<double>(f.planes); }, 0);
    printNumber(
        out, "labelled %", outcomes,
        [](const ReportedFrame& f) { return 100.0 * f.labelled_share; }, 1);
    printNumber(
        out, "ms", outcomes, [](const ReportedFrame& f) { return f.ms; }, 1);
  }
  const std::size_t done = countOf(outcomes, Status::DONE);
  out << outcomes.size() << " frames: " << done << " done";
  for (const Status status : {Status::RESUMED, Status::FAILED, Status::NOT_REACHED})
    if (countOf(outcomes, status) != 0)
      out << ", " << countOf(outcomes, status) << ' ' << statusName(status);
  out << ", " << fixed(seconds, 1) << " s";
  if (done != 0 && seconds > 0.0)
    out << ", " << fixed(static_cast<double>(done) / seconds, 1) << " frames/s";
  out << '\n';
}

} // namespace pcl_mrf_planes::apps
