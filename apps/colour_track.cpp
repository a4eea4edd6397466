// SPDX-License-Identifier: BSD-3-Clause
#include "colour_track.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::apps {

namespace {

constexpr double DEGREE = 3.14159265358979323846 / 180.0;

/// Points that carry label a in one image and label b in the other, at a * columns + b.
std::vector<double> countOverlaps(const std::vector<std::uint16_t>& before,
                                  const std::vector<std::uint16_t>& now,
                                  std::size_t rows, std::size_t columns)
{
  std::vector<double> overlap(rows * columns, 0.0);
  if (before.size() != now.size())
    return overlap;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (before[i] < rows && now[i] < columns)
      overlap[before[i] * columns + now[i]] += 1.0;
  return overlap;
}

std::vector<double> countPoints(const std::vector<std::uint16_t>& labels,
                                std::size_t planes)
{
  std::vector<double> points(planes + 1, 0.0);
  for (const std::uint16_t label : labels)
    if (label <= planes)
      points[label] += 1.0;
  return points;
}

double angle(const Plane& p, const Plane& q)
{
  return std::acos(std::max(-1.0, std::min(1.0, p.normal.dot(q.normal)))) / DEGREE;
}

} // namespace

std::vector<std::uint32_t> ColourTrack::update(const std::vector<Plane>& planes,
                                               const std::vector<std::uint16_t>& labels)
{
  std::vector<Match> matches = findMatches(planes, labels);
  std::stable_sort(matches.begin(), matches.end(),
                   [](const Match& p, const Match& q) { return p.score > q.score; });
  std::vector<std::uint32_t> numbers(planes.size(), 0);
  std::vector<bool> used(known_.size(), false);
  for (const Match& match : matches)
    if (numbers[match.plane] == 0 && !used[match.known]) {
      numbers[match.plane] = known_[match.known].number;
      used[match.known] = true;
    }
  for (std::uint32_t& number : numbers)
    if (number == 0)
      number = freeNumber(numbers);
  remember(planes, labels, numbers);
  return numbers;
}

void ColourTrack::reset()
{
  known_.clear();
  labels_.clear();
}

std::vector<ColourTrack::Match>
ColourTrack::findMatches(const std::vector<Plane>& planes,
                         const std::vector<std::uint16_t>& labels) const
{
  std::size_t last = 0; // planes of the last frame
  while (last < known_.size() && known_[last].gone == 0)
    ++last;
  const std::size_t columns = planes.size() + 1;
  const std::vector<double> overlap = countOverlaps(labels_, labels, last + 1, columns);
  const std::vector<double> before = countPoints(labels_, last);
  const std::vector<double> now = countPoints(labels, planes.size());
  std::vector<Match> matches;
  for (std::size_t j = 0; j < known_.size(); ++j)
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const double common = j < last ? overlap[(j + 1) * columns + k + 1] : 0.0;
      const double smaller = j < last ? std::min(before[j + 1], now[k + 1]) : 0.0;
      addMatch(planes[k], k, j, smaller > 0.0 ? common / smaller : 0.0, matches);
    }
  return matches;
}

void ColourTrack::addMatch(const Plane& plane, std::size_t k, std::size_t known,
                           double share, std::vector<Match>& matches) const
{
  const Tolerances& t = tolerances_;
  const bool overlaps = share >= t.share;
  const double turn =
      angle(plane, known_[known].plane) / (overlaps ? t.degrees : t.far_degrees);
  const double step =
      std::abs(plane.d - known_[known].plane.d) / (overlaps ? t.metres : t.far_metres);
  if (!(turn <= 1.0 && step <= 1.0))
    return;
  const double likeness = 2.0 - turn - step;
  constexpr double OVERLAP_FIRST = 4.0; // above all that likeness can tell
  matches.push_back({overlaps ? OVERLAP_FIRST + share + likeness : likeness, known, k});
}

/// The smallest that neither a known plane nor one of this frame has.
std::uint32_t ColourTrack::freeNumber(const std::vector<std::uint32_t>& taken) const
{
  std::vector<bool> in_use(known_.size() + taken.size() + 2, false);
  const auto use = [&](std::uint32_t number) {
    if (number < in_use.size())
      in_use[number] = true;
  };
  use(0);
  for (const std::uint32_t number : taken)
    use(number);
  for (const Known& known : known_)
    use(known.number);
  return static_cast<std::uint32_t>(std::find(in_use.begin(), in_use.end(), false) -
                                    in_use.begin());
}

void ColourTrack::remember(const std::vector<Plane>& planes,
                           const std::vector<std::uint16_t>& labels,
                           const std::vector<std::uint32_t>& numbers)
{
  std::vector<Known> next;
  for (std::size_t k = 0; k < planes.size(); ++k)
    next.push_back({planes[k], numbers[k], 0});
  for (const Known& known : known_)
    if (known.gone < tolerances_.frames &&
        std::find(numbers.begin(), numbers.end(), known.number) == numbers.end())
      next.push_back({known.plane, known.number, known.gone + 1});
  known_ = std::move(next);
  labels_ = labels;
}

} // namespace pcl_mrf_planes::apps
