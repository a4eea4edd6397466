// SPDX-License-Identifier: BSD-3-Clause
#include "adaptive/plane_merging.h"
#include "frame_memory.h"
#include "threads.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::adaptive {

namespace {

/// Takes tiles of a part of the image level by level, where none of a larger one lies yet.
class TileSelection {
public:
  /// \param cell_region region of each cell of the image, none yet in this part
  TileSelection(const TileLevel& cells, const NoiseLaw& noise,
                const AdaptiveParameters& parameters, FrameVector<int>& cell_region)
  : cells_(cells)
  , noise_(noise)
  , parameters_(parameters)
  , cell_region_(cell_region)
  {}

  /// \param[in] tiles that the part can have
  void reserve(std::size_t tiles)
  {
    regions.reserve(tiles);
    const auto columns = static_cast<std::size_t>(cells_.columns);
    free_.reserve(columns);
    sums_.reserve(columns);
    planes_.reserve(columns);
  }

  void addRow(const TileLevel& level, int row)
  {
    findFree(level, row);
    if (level.planes.empty()) {
      planes_.resize(std::max(planes_.size(), free_.size()));
      fitPlanes(sums_.data(), sums_.size(), planes_.data());
    }
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const FittedPlane& plane =
          level.planes.empty() ? planes_[k] : level.planes[level.at(free_[k], row)];
      if (isFlat(plane))
        add(level, free_[k], row, plane);
    }
  }

  FittedRegions regions;

private:
  /// Columns of a row of tiles that no larger tile covers.
  void findFree(const TileLevel& level, int row)
  {
    const int k = level.side / CELL;
    free_.clear();
    sums_.clear();
    for (int column = 0; column < level.columns; ++column) {
      const std::size_t tile = level.at(column, row);
      if (cell_region_[cells_.at(column * k, row * k)] >= 0 ||
          !isFilled(level, tile, parameters_))
        continue;
      free_.push_back(column);
      if (level.planes.empty())
        sums_.push_back(level.sums[tile]);
    }
  }

  bool isFlat(const FittedPlane& plane) const
  {
    if (plane.n < 4)
      return false;
    const double tolerance = parameters_.tile_tolerance * parameters_.tile_tolerance;
    const double mse = plane.mse * plane.n / (plane.n - 3);
    return mse <= tolerance * allowedVariance(plane, noise_, parameters_);
  }

  void add(const TileLevel& level, int column, int row, const FittedPlane& plane)
  {
    const int id = static_cast<int>(regions.planes.size());
    regions.add(plane, level.sums[level.at(column, row)]);
    const int k = level.side / CELL;
    for (int r = row * k; r < std::min((row + 1) * k, cells_.rows); ++r)
      for (int c = column * k; c < std::min((column + 1) * k, cells_.columns); ++c)
        cell_region_[cells_.at(c, r)] = id;
  }

  const TileLevel& cells_;
  const NoiseLaw& noise_;
  const AdaptiveParameters& parameters_;
  FrameVector<int>& cell_region_;
  // of the row at hand
  FrameVector<int> free_;
  FrameVector<TileSums> sums_;
  FrameVector<FittedPlane> planes_;
};

/// Where the tiles of the levels lie among those that one part of the image selected.
using LevelStarts = FrameVector<std::size_t>;

/// Numbers the tiles of all parts anew: the largest first, those of one level part by part.
class TileNumbering {
public:
  TileNumbering(FrameVector<TileSelection>& parts,
                const FrameVector<LevelStarts>& starts)
  : number_(parts.size())
  {
    for (std::size_t k = 0; k < parts.size(); ++k)
      number_[k].resize(parts[k].regions.planes.size());
    for (std::size_t level = 0; level + 1 < starts[0].size(); ++level)
      for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t i = starts[k][level]; i < starts[k][level + 1]; ++i)
          number_[k][i] = count_++;
  }

  std::size_t count() const { return static_cast<std::size_t>(count_); }
  int operator()(std::size_t part, std::size_t tile) const
  {
    return number_[part][tile];
  }

private:
  FrameVector<FrameVector<int>> number_;
  int count_ = 0;
};

} // namespace

TileRegions selectTiles(const std::vector<TileLevel>& pyramid, const NoiseLaw& noise,
                        const AdaptiveParameters& parameters, unsigned int threads)
{
  constexpr std::size_t FEW = 4; // cells a tile, about
  const auto smallest = static_cast<std::size_t>(parameters.smallest_level);
  const TileLevel& cells = pyramid[0];
  const Bands bands(pyramid.back().rows);
  const auto rowsOf = [&](const TileLevel& level, int band) {
    return rowsInside(level, pyramid.back(),
                      {bands.begin(band), bands.begin(band + 1)});
  };
  TileRegions out;
  out.cell_region.assign(cells.sums.size(), -1);
  FrameVector<TileSelection> parts(static_cast<std::size_t>(bands.count),
                                   {cells, noise, parameters, out.cell_region});
  FrameVector<LevelStarts> starts(parts.size(), {0});
  parallelParts(bands.count, threads, [&](int band) {
    const auto part = static_cast<std::size_t>(band);
    parts[part].reserve(cells.sums.size() / parts.size() / FEW);
    for (std::size_t l = pyramid.size(); l-- > smallest;) {
      const TileRows rows = rowsOf(pyramid[l], band);
      for (int row = rows.begin; row < rows.end; ++row)
        parts[part].addRow(pyramid[l], row);
      starts[part].push_back(parts[part].regions.planes.size());
    }
  });

  const TileNumbering number(parts, starts);
  parallelParts(2, threads, [&](int part) {
    if (part == 0)
      out.planes.resize(number.count());
    else
      out.sums.resize(number.count());
  });
  parallelParts(bands.count, threads, [&](int band) {
    const auto part = static_cast<std::size_t>(band);
    const FittedRegions& found = parts[part].regions;
    for (std::size_t i = 0; i < found.planes.size(); ++i) {
      const auto id = static_cast<std::size_t>(number(part, i));
      out.planes[id] = found.planes[i];
      out.sums[id] = found.sums[i];
    }
    const TileRows rows = rowsOf(cells, band);
    for (std::size_t cell = cells.at(0, rows.begin); cell < cells.at(0, rows.end);
         ++cell)
      if (int& region = out.cell_region[cell]; region >= 0)
        region = number(part, static_cast<std::size_t>(region));
  });
  return out;
}

} // namespace pcl_mrf_planes::adaptive
