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
 * A label is right if it is the best of those that compete, and if its plane is there:
 * the confidence is the product of a share for either. The first one follows from the gap
 * g, what the second best label would cost more, and s, the price of a label change
 * between neighbours on a smooth surface.
 *
 * Method::ADAPTIVE: 1 - exp(-(g / 2s)^2 / 2), s being label_change. It keeps no beliefs;
 * the gap is an approximation of one step: the final planes, data cost and Potts prices of
 * the random field, and of the neighbours the labels that they got in the end. Beside "no
 * plane" there is always a plane that was not found. Times e / (e + 1000) for a plane
 * whose equation saves e nats in the description of its points (min_evidence), in points
 * of independent noise: small planes, and those hardly wider than their noise, are chance
 * or parts of something else more often.
 *
 * Method::PAPER: 1 - exp(-2 g / s), g being the gap of the beliefs (propagateRowGaps()) of a
 * field that is made once more, propagated as often as for the labels, and s the median
 * price of two planes; 1 where there is but one. Times 1 / (1 + (r / 5 sigma)^2) at a
 * distance r from the plane, sigma being the noise that a tile may have there: beliefs do
 * not tell how far away all planes are. About the time of the segmentation.
 *
 * The shapes are from what the gap and the evidence are measures of, their scales from how
 * often labels were right on data with ground truth, one scale for all sets. It does not
 * know whether a plane is one that a person would have drawn.
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
