// SPDX-License-Identifier: BSD-3-Clause
#include "region_area.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_mrf_planes {

namespace {

/// Columns that a run and one of the same label below it have in common: the whole faces
/// between the two rows.
struct Strip {
  std::size_t begin; ///< upper row: index of the first point
  std::size_t end;   ///< one past the last
  std::uint16_t label;
  const LabelRun* upper;
  const LabelRun* lower;
};

/// Adds up the border of the mesh of each label.
class MeshBorder {
public:
  MeshBorder(const OrganizedPoints& points, const std::vector<Plane>& planes,
             const LabelRuns& image)
  : twice_areas(planes.size(), 0.0)
  , points_(points)
  , planes_(planes)
  , image_(image)
  {}

  /// Adds what lies between the points of some rows and those of the next ones, and along
  /// the former.
  void addRows(std::size_t first, std::size_t last)
  {
    const std::size_t height = image_.rows.size() - 1;
    FrameVector<Strip> above;
    FrameVector<Strip> below;
    if (first > 0)
      findStrips(first - 1, above);
    for (std::size_t row = first; row < last; ++row) {
      below.clear();
      if (row + 1 < height) {
        findStrips(row, below);
        for (const Strip& strip : below)
          addStrip(strip);
      }
      addEdges(above, below, image_.width);
      std::swap(above, below);
    }
  }

  MeshBorder& operator+=(const MeshBorder& other)
  {
    addTo(twice_areas, other.twice_areas);
    return *this;
  }

  FrameVector<double> twice_areas;

private:
  /// n . (p x q): what the edge from p to q adds to twice the area of its label.
  double edge(std::size_t p, std::size_t q, std::uint16_t label) const
  {
    const Eigen::Vector3d from(points_.x[p], points_.y[p], points_.z[p]);
    const Eigen::Vector3d to(points_.x[q], points_.y[q], points_.z[q]);
    return planes_[label].normal.dot(from.cross(to));
  }

  /// Strips between a row and the next one.
  void findStrips(std::size_t row, FrameVector<Strip>& strips) const
  {
    const std::size_t width = image_.width;
    forEachOverlap(image_, row, [&](std::size_t a, std::size_t b) {
      const LabelRun& upper = image_.runs[a];
      const LabelRun& lower = image_.runs[b];
      if (upper.label == lower.label)
        strips.push_back({std::max(upper.begin, lower.begin - width),
                          std::min(upper.end, lower.end - width), upper.label, &upper,
                          &lower});
    });
  }

  /// Down the right side of a strip and up the left one: around the triangle beside it where
  /// one of the runs goes on and the other ends.
  void addStrip(const Strip& strip)
  {
    const std::size_t width = image_.width;
    const LabelRun& upper = *strip.upper;
    const LabelRun& lower = *strip.lower;
    const std::size_t right = strip.end - 1;
    if (upper.end > strip.end)
      addWay(right, right + 1, right + width, strip.label);
    else if (lower.end - width > strip.end)
      addWay(right, right + width + 1, right + width, strip.label);
    else
      twice_areas[strip.label] += edge(right, right + width, strip.label);
    const std::size_t left = strip.begin;
    if (upper.begin < strip.begin)
      addWay(left + width, left - 1, left, strip.label);
    else if (lower.begin - width < strip.begin)
      addWay(left + width, left + width - 1, left, strip.label);
    else
      twice_areas[strip.label] += edge(left + width, left, strip.label);
  }

  void addWay(std::size_t from, std::size_t over, std::size_t to, std::uint16_t label)
  {
    twice_areas[label] += edge(from, over, label) + edge(over, to, label);
  }

  /// Edges along a row: those with a face below but none above, from left to right, and
  /// those with a face above but none below, back.
  void addEdges(const FrameVector<Strip>& above, const FrameVector<Strip>& below,
                std::size_t width)
  {
    addUncovered(below, 0, above, width, 1.0);
    addUncovered(above, width, below, 0, -1.0);
  }

  /// Edges of the strips that no strip of the other side of the row covers. Each side's
  /// points lie so far from the row itself.
  void addUncovered(const FrameVector<Strip>& strips, std::size_t offset,
                    const FrameVector<Strip>& others, std::size_t other_offset,
                    double sign)
  {
    std::size_t k = 0;
    for (const Strip& strip : strips) {
      std::size_t p = strip.begin + offset;
      const std::size_t last = strip.end - 1 + offset;
      while (k < others.size() && others[k].end - 1 + other_offset <= p)
        ++k;
      for (std::size_t o = k; o < others.size() && p < last; ++o) {
        const std::size_t covered = others[o].begin + other_offset;
        const std::size_t covered_to = others[o].end - 1 + other_offset;
        if (covered >= last)
          break;
        if (covered_to <= covered)
          continue; // a single column has no edge
        addRange(p, std::max(p, covered), strip.label, sign);
        p = std::max(p, covered_to);
      }
      addRange(p, last, strip.label, sign);
    }
  }

  void addRange(std::size_t p, std::size_t last, std::uint16_t label, double sign)
  {
    for (; p < last; ++p)
      twice_areas[label] += sign * edge(p, p + 1, label);
  }

  const OrganizedPoints& points_;
  const std::vector<Plane>& planes_;
  const LabelRuns& image_;
};

} // namespace

FrameVector<double> meshAreas(const OrganizedPoints& points,
                              const std::vector<Plane>& planes, const LabelRuns& image,
                              unsigned int threads)
{
  FrameVector<double> areas =
      sumOfBands(static_cast<int>(image.rows.size()) - 1, threads,
                 MeshBorder(points, planes, image),
                 [](int first, int last, MeshBorder& border) {
                   border.addRows(static_cast<std::size_t>(first),
                                  static_cast<std::size_t>(last));
                 })
          .twice_areas;
  for (double& area : areas)
    area = std::abs(area) / 2;
  return areas;
}

} // namespace pcl_mrf_planes
