// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/output_file.h>

namespace pcl_mrf_planes::apps {

using io::checkWritable;
using io::writeAtomically;
using io::writeBytes;

} // namespace pcl_mrf_planes::apps
