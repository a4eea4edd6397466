// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief The whole square blocks of an image, row by row. What is left over at the
 * right and at the bottom belongs to none. */
struct BlockGrid {
  int width = 0, height = 0; ///< of the image, points
  int side = 10;             ///< of a block, points

  int columns() const { return width / side; }
  int rows() const { return height / side; }
  std::size_t size() const
  {
    return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows());
  }
  int block(int row, int column) const { return row * columns() + column; }

  /** \brief Index of a point in the cloud. */
  std::size_t point(int row, int column) const
  {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }

  /** \brief The block of a point, -1: none. */
  int blockAt(int point_row, int point_column) const
  {
    const int row = point_row / side, column = point_column / side;
    return row < rows() && column < columns() ? block(row, column) : -1;
  }

  /** \brief First row or column of the points of a block. */
  int firstRow(int block) const { return block / columns() * side; }
  int firstColumn(int block) const { return block % columns() * side; }

  /** \brief Left, right, upper, lower neighbour of a block; -1 beyond the grid. */
  std::array<int, 4> neighbours(int block) const
  {
    const int row = block / columns(), column = block % columns();
    return {column > 0 ? block - 1 : -1, column + 1 < columns() ? block + 1 : -1,
            row > 0 ? block - columns() : -1,
            row + 1 < rows() ? block + columns() : -1};
  }
};

} // namespace pcl_mrf_planes::benchmarks
