// SPDX-License-Identifier: BSD-3-Clause
#include "segmented_frame.h"

#include "wrapped_cloud.h"

#include <pcl_mrf_planes/io/cloud_fields.h>

#include <exception>
#include <new>
#include <stdexcept>

namespace pcl_mrf_planes::apps {

FrameAndResult segmentFrame(const io::FrameSource& source, const Options& options)
{
  FrameAndResult all;
  all.frame = source.read();
  try {
    all.cloud = io::coordinates(all.frame.file);
    all.result = options.wrap
                     ? segmentWrapped(*all.cloud, options.parameters, options.repeat)
                     : segmentCloud(all.cloud, options.parameters, options.repeat,
                                    options.regions);
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception& error) { // the name in front of what is wrong with it
    throw std::runtime_error("'" + source.input + "' " + error.what());
  }
  return all;
}

} // namespace pcl_mrf_planes::apps
