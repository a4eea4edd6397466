// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "study.h"

#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief The defaults, and each capability switched off by itself. */
std::vector<Variant> ablationVariants();

/** \brief The defaults, and each numeric parameter by itself at a quarter to four times its
 * default, named "NAME VALUE instead of DEFAULT". */
std::vector<Variant> sensitivityVariants();

/** \brief Profiles and other methods on clouds of growing noise: generated rooms, seen by
 * a Kinect (the set is "kinect SCALE"), and the scans of the set "synpeb" among
 * \a clouds with noise along the ray ("synpeb MILLIMETRES"). */
Study noiseStudy(const std::vector<LabelledCloud>& clouds, unsigned int threads);

} // namespace pcl_mrf_planes::benchmarks
