// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/candidate_field.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_mrf_planes::adaptive {

CandidateBlocks findCandidates(const TileRegions& regions, const TileLevel& cells,
                               int width, int height)
{
  CandidateBlocks out;
  out.columns = (width + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  out.rows = (height + CandidateBlocks::SIDE - 1) / CandidateBlocks::SIDE;
  const std::size_t blocks =
      static_cast<std::size_t>(out.columns) * static_cast<std::size_t>(out.rows);
  out.labels.assign(blocks * CandidateBlocks::SLOTS, 0);
  out.count.assign(blocks, 1);
  const int k = CandidateBlocks::SIDE / cells.side;
  const int reach = 2 * k;
  std::vector<std::pair<int, int>> found; // distance, region
  for (int r = 0; r < out.rows; ++r)
    for (int c = 0; c < out.columns; ++c) {
      found.clear();
      for (int j = std::max(0, r * k - reach);
           j < std::min(cells.rows, (r + 1) * k + reach); ++j)
        for (int i = std::max(0, c * k - reach);
             i < std::min(cells.columns, (c + 1) * k + reach); ++i) {
          const int id = regions.cell_region[cells.at(i, j)];
          if (id < 0)
            continue;
          const int dx = std::max({0, c * k - i, i - (c + 1) * k + 1});
          const int dy = std::max({0, r * k - j, j - (r + 1) * k + 1});
          const int d = std::max(dx, dy);
          auto it = std::find_if(found.begin(), found.end(),
                                 [&](const auto& f) { return f.second == id; });
          if (it == found.end())
            found.emplace_back(d, id);
          else
            it->first = std::min(it->first, d);
        }
      std::sort(found.begin(), found.end());
      const std::size_t b =
          static_cast<std::size_t>(r) * static_cast<std::size_t>(out.columns) +
          static_cast<std::size_t>(c);
      const std::size_t n =
          std::min<std::size_t>(found.size(), CandidateBlocks::SLOTS - 1);
      for (std::size_t s = 0; s < n; ++s)
        out.labels[b * CandidateBlocks::SLOTS + s + 1] =
            static_cast<std::uint16_t>(found[s].second + 1);
      out.count[b] = static_cast<std::uint8_t>(n + 1);
    }
  return out;
}

namespace {

constexpr int SIDE = CandidateBlocks::SIDE;

/// Where the costs of a region's label differ from those of another.
struct LabelScale {
  float a, b, c, d;
  double growth; ///< variance of the region over that of its points
  double bend;   ///< squared deviation from flatness, m^2
};

LabelScale labelScale(const FittedPlane& plane, const NoiseLaw& noise,
                      const AdaptiveParameters& parameters)
{
  const double growth = noise.growthOf(plane.n);
  const double bend =
      std::min(parameters.flatness * plane.extent, parameters.max_flatness);
  return {
      static_cast<float>(plane.normal.x()),     static_cast<float>(plane.normal.y()),
      static_cast<float>(plane.normal.z()),     static_cast<float>(plane.d),
      growth * growth * incidenceFactor(plane), bend * bend};
}

/// Fills one block of a field: all that is asked of its cells is asked once.
class BlockFiller {
public:
  BlockFiller(const OrganizedPoints& points, const TileRegions& regions,
              const TileLevel& cells, const NoiseLaw& noise,
              const AdaptiveParameters& parameters, CandidateField& field)
  : points_(points)
  , cells_(cells)
  , noise_(noise)
  , parameters_(parameters)
  , field_(field)
  {
    const double largest_sum =
        MOST * parameters.none_cost + 4.0 * parameters.label_change;
    units_ = static_cast<float>((INT16_MAX - ROUNDING) / largest_sum);
    for (const FittedPlane& plane : regions.planes)
      scales_.push_back(labelScale(plane, noise, parameters));
  }

  void fill(int column, int row)
  {
    const std::size_t block = field_.blocks.at(column, row);
    const int bottom = std::min(SIDE, field_.height - row * SIDE);
    const int right = std::min(SIDE, field_.width - column * SIDE);
    for (int r = 0; r < bottom; ++r)
      for (int k = 0; k < right; ++k)
        fillPoint(block, column * SIDE + k, row * SIDE + r, r,
                  static_cast<std::size_t>(k));
  }

private:
  void fillPoint(std::size_t block, int u, int v, int r, std::size_t k)
  {
    const auto width = static_cast<std::size_t>(field_.width);
    const std::size_t i =
        static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
    if (points_.valid[i] == 0)
      return;
    enterCell(block, u / cells_.side, v / cells_.side);
    const std::size_t start = field_.dataRow(block, r);
    const auto none = static_cast<float>(parameters_.none_cost);
    field_.data[start].v[k] = units(none);
    for (std::size_t s = 1; s < field_.blocks.count[block]; ++s) {
      const LabelScale& scale = scales_[field_.blocks.labelsOf(block)[s] - 1u];
      const float distance = std::abs(scale.a * points_.x[i] + scale.b * points_.y[i] +
                                      scale.c * points_.z[i] + scale.d);
      field_.data[start + s].v[k] =
          units(std::min(distance * per_sigma_[s], MOST * none)); // as (7), in sigmas
    }
    const std::size_t weights = CandidateField::weightRow(block, r);
    if (u + 1 < field_.width && points_.valid[i + 1] != 0)
      field_.right[weights].v[k] = weight(i, i + 1);
    if (v + 1 < field_.height && points_.valid[i + width] != 0)
      field_.down[weights].v[k] = weight(i, i + width);
  }

  /// Noise is known by cell: looks up what all its points share.
  void enterCell(std::size_t block, int column, int row)
  {
    const std::size_t cell = cells_.at(column, row);
    if (cell == cell_ && block == block_)
      return;
    cell_ = cell;
    block_ = block;
    const TileSums& sums = cells_.sums[cell];
    const double variance = sums.noise / sums.n;
    const double range = sums.centroid().norm();
    per_step_ = static_cast<float>(
        1.0 / (parameters_.step_sigmas * noise_.small(range) + STEP_SHARE * range));
    for (std::size_t s = 1; s < field_.blocks.count[block]; ++s) {
      const LabelScale& scale = scales_[field_.blocks.labelsOf(block)[s] - 1u];
      per_sigma_[s] =
          static_cast<float>(1.0 / std::sqrt(scale.growth * variance + scale.bend));
    }
  }

  /// Potts weight that falls with the depth step, down to a share of itself.
  std::int16_t weight(std::size_t i, std::size_t j) const
  {
    const float step = (points_.depth(i) - points_.depth(j)) * per_step_;
    const float share = std::max(static_cast<float>(parameters_.min_weight),
                                 1.0f / (1.0f + step * step));
    return units(static_cast<float>(parameters_.label_change) * share);
  }

  std::int16_t units(float cost) const
  {
    return static_cast<std::int16_t>(std::lrintf(cost * units_));
  }

  static constexpr int ROUNDING = 5;  ///< terms of a sum, each rounded up at worst
  static constexpr float MOST = 3.0f; ///< cut of the data cost over "no plane"'s
  static constexpr double STEP_SHARE = 0.01; ///< of the range: a slope, not a step

  const OrganizedPoints& points_;
  const TileLevel& cells_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  CandidateField& field_;
  std::vector<LabelScale> scales_;
  std::size_t cell_ = SIZE_MAX;
  std::size_t block_ = SIZE_MAX;
  float units_ = 1.0f; ///< in one sigma
  float per_step_ = 0.0f;
  std::array<float, CandidateBlocks::SLOTS> per_sigma_ = {};
};

/// Rows of the image one after another, as the propagation goes through them.
void layOutRows(CandidateField& field)
{
  const CandidateBlocks& blocks = field.blocks;
  std::size_t start = 0;
  for (int row = 0; row < blocks.rows; ++row) {
    std::size_t length = 0;
    for (int column = 0; column < blocks.columns; ++column) {
      field.first.push_back(start + length);
      length += blocks.count[blocks.at(column, row)];
    }
    field.stride.insert(field.stride.end(), static_cast<std::size_t>(blocks.columns),
                        length);
    start += length * static_cast<std::size_t>(SIDE);
  }
  field.data.resize(start);
}

} // namespace

CandidateField buildField(const OrganizedPoints& points, const TileRegions& regions,
                          const TileLevel& cells, const NoiseLaw& noise,
                          const AdaptiveParameters& parameters)
{
  CandidateField field;
  field.width = points.width;
  field.height = points.height;
  field.blocks = findCandidates(regions, cells, field.width, field.height);
  layOutRows(field);
  const std::size_t weights =
      field.blocks.count.size() * static_cast<std::size_t>(SIDE);
  field.right.resize(weights);
  field.down.resize(weights);
  BlockFiller filler(points, regions, cells, noise, parameters, field);
  for (int row = 0; row < field.blocks.rows; ++row)
    for (int column = 0; column < field.blocks.columns; ++column)
      filler.fill(column, row);
  return field;
}

} // namespace pcl_mrf_planes::adaptive
