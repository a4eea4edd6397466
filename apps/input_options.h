// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/frame.h>

#include <boost/program_options.hpp>

namespace pcl_mrf_planes::apps {

/** \brief Options about the inputs: camera, size, frames to list. */
boost::program_options::options_description inputOptions();

/** \brief What they say.
 * \throws UsageError */
io::ReadOptions readInputOptions(const boost::program_options::variables_map& values);

} // namespace pcl_mrf_planes::apps
