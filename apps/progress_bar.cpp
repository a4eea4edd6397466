// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.h"

#include "text_cells.h"

#include <unistd.h>

#include <cmath>
#include <iostream>

namespace pcl_mrf_planes::apps {

namespace {

constexpr std::size_t BAR = 30; // characters

/// 12 s, 3 min 05 s, 2 h 07 min
std::string duration(double seconds)
{
  const auto all = std::lround(seconds);
  const auto two = [](long number) {
    return (number < 10 ? "0" : "") + std::to_string(number);
  };
  if (all < 60)
    return std::to_string(all) + " s";
  if (all < 3600)
    return std::to_string(all / 60) + " min " + two(all % 60) + " s";
  return std::to_string(all / 3600) + " h " + two(all % 3600 / 60) + " min";
}

} // namespace

std::string progressLine(std::size_t done, std::size_t total, double seconds)
{
  const std::size_t filled = total == 0 ? BAR : BAR * done / total;
  std::string line = "[" + std::string(filled, '#') + std::string(BAR - filled, ' ') +
                     "] " + std::to_string(done) + "/" + std::to_string(total);
  if (done == 0 || seconds <= 0.0)
    return line;
  const double rate = static_cast<double>(done) / seconds;
  return line + "  " + fixed(rate, 1) + " frames/s, " +
         duration(static_cast<double>(total - done) / rate) + " left";
}

ProgressBar::ProgressBar(std::size_t total, bool shown)
: total_(total)
, shown_(shown && ::isatty(STDERR_FILENO) == 1)
, start_(std::chrono::steady_clock::now())
{
  draw();
}

ProgressBar::~ProgressBar()
{
  clear();
}

void ProgressBar::advance()
{
  ++done_;
  draw();
}

void ProgressBar::say(const std::string& line)
{
  clear();
  std::cerr << line << std::endl;
  draw();
}

void ProgressBar::draw() const
{
  if (!shown_)
    return;
  const std::chrono::duration<double> passed =
      std::chrono::steady_clock::now() - start_;
  std::cerr << '\r' << progressLine(done_, total_, passed.count()) << "\x1b[K"
            << std::flush;
}

void ProgressBar::clear() const
{
  if (shown_)
    std::cerr << "\r\x1b[K" << std::flush;
}

} // namespace pcl_mrf_planes::apps
