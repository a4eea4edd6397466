// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adaptive/plane_merging.h"
#include "frame_memory.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::adaptive {

/** \brief The step that AdaptiveParameters::sampling gives for these points, made shorter
 * until AdaptiveParameters::least_samples are left; 1 or more. */
int samplingStep(const OrganizedPoints& points, const AdaptiveParameters& parameters);

/** \brief Every so many-th point of every so many-th row, from the first on.
 * O(points / every^2) */
OrganizedPoints samplePoints(const OrganizedPoints& points, int every,
                             unsigned int threads = 1);

/** \brief The same in the memory of others. */
void samplePoints(const OrganizedPoints& points, int every, unsigned int threads,
                  OrganizedPoints& samples);

/** \brief Labels of all points from those of the sampled ones (0 none, k planes[k - 1]).
 *
 * Points between samples of one label take it. Elsewhere a point takes, of the labels
 * around it, the plane that it is nearest to in sigmas, or none where that is one of
 * them and costs less. O(points) */
std::vector<std::uint16_t>
spreadLabels(const OrganizedPoints& points, const OrganizedPoints& samples,
             const std::vector<std::uint16_t>& labels, int every,
             const FrameVector<FittedPlane>& planes, const NoiseLaw& noise,
             const AdaptiveParameters& parameters, unsigned int threads = 1);

/** \brief The same into labels that are there already. */
void spreadLabels(const OrganizedPoints& points, const OrganizedPoints& samples,
                  const std::vector<std::uint16_t>& labels, int every,
                  const FrameVector<FittedPlane>& planes, const NoiseLaw& noise,
                  const AdaptiveParameters& parameters, unsigned int threads,
                  std::vector<std::uint16_t>& out);

} // namespace pcl_mrf_planes::adaptive
