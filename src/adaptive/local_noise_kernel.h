// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/noise_estimation.h"

#include <cstddef>

namespace pcl_mrf_planes::adaptive {

/// Cells side by side that share a factor.
constexpr std::size_t CELLS_A_FACTOR = 4;

/** \brief Fills in TileSums::noise of a row of cells: of each point the variance of the law at the
 * range of the cell's centroid, times the square of a factor. Cells of no points keep none.
 * \param[in] factors one for every CELLS_A_FACTOR cells, from the first
 * The same bits for every instruction set. O(count) */
void assignNoise(TileSums* cells, std::size_t count, const double* factors,
                 const NoiseLaw& noise);

} // namespace pcl_mrf_planes::adaptive
