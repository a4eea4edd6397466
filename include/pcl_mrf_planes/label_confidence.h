// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane_segmentation.h>

#include <vector>

namespace pcl_mrf_planes {

/** \brief How sure the label of every point is: 0 as good as another label, towards 1 the
 * more another would cost; 0 for invalid points. Row by row.
 *
 * The gap g is what the second best label would cost more, and the confidence is
 * 1 - exp(-g / 2s) with s the price of a label change between neighbours on a smooth
 * surface (label_change; of Method::PAPER the median price of two planes).
 *
 * Method::PAPER: the gap of the beliefs (propagateRowGaps()) of a field that is made once
 * more, propagated as often as for the labels: about the time of the segmentation.
 *
 * Method::ADAPTIVE keeps no beliefs. The gap is an approximation of one step: the final
 * planes, data cost and Potts prices of the random field, and of the neighbours the labels
 * that they got in the end. It knows how well a point fits its plane beside others and "no
 * plane", and whether its neighbours agree; it does not know whether a plane is one that a
 * person would have drawn. Beside "no plane" there is always a plane that was not found.
 *
 * Measured against ground truth in doc/accuracy.md. O(points * labels near a point); of
 * Method::PAPER O(points * labels * iterations).
 * \param[in] points the cloud in the sensor frame
 * \param[in] result of segmentPlanes() with the same points and parameters
 * \param[in] parameters those of the segmentation; threads as well
 */
PCL_MRF_PLANES_EXPORT std::vector<float>
labelConfidence(const OrganizedPoints& points, const PlaneSegmentation& result,
                const Parameters& parameters);

} // namespace pcl_mrf_planes
