// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "viewer_window.h"

#include <pcl_mrf_planes/io/frame.h>
#include <pcl_mrf_planes/parameters.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief What the command line of pcl_mrf_plane_viewer asks for. */
struct ViewerOptions {
  bool help = false;
  bool version = false;
  std::vector<std::string> inputs;
  io::ReadOptions read;
  Profile profile = Profile::DEFAULT;
  Parameters parameters;
  std::string parameter_file;
  std::vector<std::string> keys; ///< pressed at the start
  std::string screenshot;        ///< off-screen: a picture
  std::string film;              ///< off-screen: a folder of pictures
  WindowOptions window;
};

/** \brief Read the command line. \throws UsageError with what is wrong and what to do */
ViewerOptions parseViewerOptions(int argc, const char* const argv[]);

/** \brief The text of --help. */
std::string viewerHelp();

} // namespace pcl_mrf_planes::viewer
