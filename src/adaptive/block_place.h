// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"

#include <cmath>
#include <cstdint>

namespace pcl_mrf_planes::adaptive {

/// A block of the field in the image: its number, its first point, and how many of its points
/// lie in the image.
struct BlockPlace {
  std::size_t block;
  int column, row;
  int columns, rows;

  /// Index of the first point of a row of the block in an image of that width.
  std::size_t pointAt(int row_of_block, int width) const
  {
    return static_cast<std::size_t>(row + row_of_block) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

/// Costs in the whole numbers of a field.
struct CostUnits {
  float per_sigma = 1.0f;

  std::int16_t operator()(float sigmas) const
  {
    return static_cast<std::int16_t>(std::lrint(sigmas * per_sigma));
  }
};

} // namespace pcl_mrf_planes::adaptive
