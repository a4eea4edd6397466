// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/candidate_field.h"

#include <pcl_mrf_planes/plane_field.h>

namespace pcl_mrf_planes::adaptive {

/** \brief Energy of labels that the field allows, in sigmas: data costs of the points of the
 * blocks with a choice, and prices of the changes of label at their edges, each edge once.
 * What the settled blocks cost is the same for all labels. O(points) */
FieldEnergy fieldEnergy(const CandidateField& field, const OrganizedPoints& points,
                        const std::vector<std::uint16_t>& labels,
                        const AdaptiveParameters& parameters);

} // namespace pcl_mrf_planes::adaptive
