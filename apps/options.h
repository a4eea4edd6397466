// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "batch_options.h"
#include "parameter_options.h"
#include "region_options.h"

#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/frame.h>
#include <pcl_mrf_planes/parameters.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief What the command line of pcl_mrf_plane_segmentation asks for. */
struct Options {
  bool help = false;
  bool version = false;
  std::vector<std::string> inputs; ///< one, unless a batch is wanted
  io::ReadOptions read;
  BatchOptions batch;
  std::string output; ///< empty: none wanted, as for the other files
  std::optional<io::PcdFormat> format;
  std::string models;
  std::string label_image;
  std::string overlay;
  std::string masks; ///< a folder
  std::string ply;
  std::string save_parameters;
  std::string stages; ///< a folder
  std::string figure;
  int repeat = 1;
  bool wrap = false; ///< the last column is the neighbour of the first
  bool timing = false;
  bool quiet = false;
  std::string profile = "default";
  Parameters parameters;
  RegionOptions regions;

  /** \brief Whether nothing is to be segmented, of so many input files. */
  bool onlySavesParameters(std::size_t files) const
  {
    return files == 0 && !save_parameters.empty() && !batch.active();
  }
};

/** \brief Read the command line and the configuration file it names.
 * \throws UsageError with what is wrong and what to do
 */
Options parseOptions(int argc, const char* const argv[]);

/** \brief The text of --help. */
std::string helpText();

} // namespace pcl_mrf_planes::apps
