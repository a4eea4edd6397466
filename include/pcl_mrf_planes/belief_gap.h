// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/belief_propagation.h>
#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/grid_field.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief How much worse the second best label of every site is, by its beliefs.
 *
 * A belief, data cost plus messages, stands for the least energy of all labellings with
 * that label at that site (its min-marginal): exactly, but for a constant, on chains and
 * trees once the messages have crossed them, nearly on grids. The gap is what it would cost
 * to give the site any other label than the one that mapLabels() gives it.
 *
 * In the field's 16-bit units, row by row; 65535 where there is but one label.
 * O(sites * labels)
 * \param[in] field the field that \a propagation works on
 * \param[in] propagation after its iterations
 */
PCL_MRF_PLANES_EXPORT std::vector<std::uint16_t>
beliefGaps(const GridField& field, const BeliefPropagation& propagation);

} // namespace pcl_mrf_planes
