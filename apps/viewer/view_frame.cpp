// SPDX-License-Identifier: BSD-3-Clause
#include "view_frame.h"

#include "pictures.h"

#include <pcl_mrf_planes/io/cloud_fields.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <utility>

namespace pcl_mrf_planes::viewer {

ViewFrame readFrame(const io::FrameSource& source)
{
  io::Frame frame = source.read();
  ViewFrame view;
  view.name = source.name;
  view.colours = std::move(frame.colours);
  try {
    view.given.assign(frame.truth.begin(), frame.truth.end());
    if (view.given.empty())
      view.given = io::labels(frame.file);
    view.cloud = io::coordinates(frame.file);
    view.points = apps::inSensorFrame(*view.cloud, DepthMeasure::AUTO);
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception& error) { // the name in front of what is wrong with it
    throw std::runtime_error("'" + source.input + "' " + error.what());
  }
  return view;
}

} // namespace pcl_mrf_planes::viewer
