// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/field_rows.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief MAP labels after a fixed number of checkerboard iterations, in one sweep.
 *
 * The same labels, bit for bit, as BeliefPropagation::iterate() and mapLabels(), from a
 * tenth of the memory. Iteration t needs of iteration t - 1 nothing below the next row:
 * so the iterations follow each other down the image one row apart, and only the rows
 * between the first and the last of them are kept, which fits into a cache. Costs are
 * asked for once, when the first iteration reaches their row.
 *
 * With EdgeModel::SOFT_THRESHOLD the messages of the last iteration are not sent: only the
 * least belief counts after them, and few labels can still have it.
 *
 * Threads share the image in bands. A band starts and ends \a iterations rows early and
 * late, which is as far as a message can have come, so the bands need nothing from each
 * other and the labels do not depend on their number.
 *
 * O(sites * iterations * L^2) at worst, usually far less, see BeliefPropagation. Memory
 * a thread: 10 L bytes a site for iterations + 3 rows (less if the image is smaller).
 *
 * \param[in] field costs, see GridField for their range
 * \param[in] iterations checkerboard iterations, >= 0
 * \param[in] threads 0: as many as the machine has cores
 * \return a label for every site, row by row; ties go to the smallest label
 */
PCL_MRF_PLANES_EXPORT std::vector<std::uint16_t>
propagateRows(const FieldRows& field, int iterations, unsigned int threads = 1);

/** \brief beliefGaps() after the same sweep instead of the labels, the same bits: how much
 * worse the second best label of every site is. Costs about as much as propagateRows(). */
PCL_MRF_PLANES_EXPORT std::vector<std::uint16_t>
propagateRowGaps(const FieldRows& field, int iterations, unsigned int threads = 1);

} // namespace pcl_mrf_planes
