// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/frame.h>
#include <pcl_mrf_planes/organized_points.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief A frame as the viewer holds it. */
struct ViewFrame {
  std::string name;
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud; ///< organized, in its own frame
  std::vector<io::Colour> colours;           ///< one for each point, or none
  std::vector<std::uint32_t> given; ///< labels that came with it: 0 none; or empty
  OrganizedPoints points;           ///< the same in the frame of its sensor
};

/** \brief Read a frame.
 * \throws std::runtime_error with the input's name, what is wrong and what to do */
ViewFrame readFrame(const io::FrameSource& source);

} // namespace pcl_mrf_planes::viewer
