// SPDX-License-Identifier: BSD-3-Clause
#include "contingency_table.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace pcl_mrf_planes::evaluation {

namespace {

/// Points by label of the truth and label of the result, sorted by both.
using Overlaps = std::map<std::pair<std::uint16_t, std::uint16_t>, std::int64_t>;

/// Neighbours mostly share both labels: the hash table is asked once for each run.
Overlaps countOverlaps(const LabelImage& truth, const LabelImage& labels)
{
  std::unordered_map<std::uint32_t, std::int64_t> counts;
  for (std::size_t i = 0; i < truth.size();) {
    const std::size_t start = i;
    while (i < truth.size() && truth.labels[i] == truth.labels[start] &&
           labels.labels[i] == labels.labels[start])
      ++i;
    const std::uint32_t key =
        static_cast<std::uint32_t>(truth.labels[start]) << 16 | labels.labels[start];
    counts[key] += static_cast<std::int64_t>(i - start);
  }
  Overlaps sorted;
  for (const auto& entry : counts)
    sorted[{static_cast<std::uint16_t>(entry.first >> 16),
            static_cast<std::uint16_t>(entry.first & 0xffff)}] = entry.second;
  return sorted;
}

/// Without the points that are not scored, and the regions that are not judged as no
/// plane.
Overlaps scored(const Overlaps& all)
{
  std::map<std::uint16_t, std::int64_t> whole, inside;
  for (const auto& [pair, points] : all) {
    whole[pair.second] += points;
    inside[pair.second] += pair.first == NOT_SCORED ? 0 : points;
  }
  Overlaps result;
  for (const auto& [pair, points] : all)
    if (pair.first != NOT_SCORED) {
      const bool judged = 2 * inside[pair.second] >= whole[pair.second];
      result[{pair.first, judged ? pair.second : std::uint16_t{0}}] += points;
    }
  return result;
}

/// The regions of one image, and where each label stands among them.
std::vector<ContingencyTable::Region>
makeRegions(const std::map<std::uint16_t, std::int64_t>& points,
            std::map<std::uint16_t, std::size_t>& index)
{
  std::vector<ContingencyTable::Region> regions;
  for (const auto& [label, count] : points) {
    index[label] = regions.size();
    regions.push_back({label, count, 0});
  }
  return regions;
}

ContingencyTable makeTable(const Overlaps& overlaps)
{
  std::map<std::uint16_t, std::int64_t> rows, columns;
  for (const auto& [pair, points] : overlaps) {
    rows[pair.first] += points;
    columns[pair.second] += points;
  }
  std::map<std::uint16_t, std::size_t> row, column;
  ContingencyTable table;
  table.truth = makeRegions(rows, row);
  table.labels = makeRegions(columns, column);
  for (const auto& [pair, points] : overlaps) {
    table.cells.push_back({row[pair.first], column[pair.second], points});
    table.points += points;
    if (pair.first == 0)
      table.labels[column[pair.second]].on_no_plane = points;
    if (pair.second == 0)
      table.truth[row[pair.first]].on_no_plane = points;
  }
  return table;
}

std::string sizeOf(const LabelImage& image)
{
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void checkComplete(const LabelImage& image, const char* name)
{
  if (image.width < 0 || image.height < 0 ||
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) !=
          image.size())
    throw std::invalid_argument(std::string("the ") + name + " is " + sizeOf(image) +
                                " points but has " + std::to_string(image.size()) +
                                " labels");
}

} // namespace

int ContingencyTable::countTruePlanes(std::int64_t min_points) const
{
  return static_cast<int>(
      std::count_if(truth.begin(), truth.end(), [&](const Region& region) {
        return region.isPlane() && region.points > min_points;
      }));
}

void checkComparable(const LabelImage& truth, const LabelImage& labels)
{
  checkComplete(truth, "truth");
  checkComplete(labels, "result");
  if (truth.width != labels.width || truth.height != labels.height)
    throw std::invalid_argument("the truth is " + sizeOf(truth) +
                                " points, the result " + sizeOf(labels));
}

ContingencyTable compareLabels(const LabelImage& truth, const LabelImage& labels)
{
  checkComparable(truth, labels);
  return makeTable(scored(countOverlaps(truth, labels)));
}

} // namespace pcl_mrf_planes::evaluation
