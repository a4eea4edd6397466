// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/plane_creases.h>
#include <pcl_mrf_planes/plane_projection.h>
#include <pcl_mrf_planes/region_polygons.h>

#include <boost/program_options.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_mrf_planes::apps {

/** \brief What is asked for beside labels and planes. */
struct RegionOptions {
  bool separate_patches = false;
  bool outlines = false;   ///< in the report
  bool creases = false;    ///< in the report
  bool confidence = false; ///< as a field of OUT.pcd
  std::string confidence_image;
  std::string polygons; ///< PLY
  std::string rest;     ///< PCD without the points of planes
  std::optional<ProjectionWay> project;
  OutlineParameters outline;
  CreaseParameters crease;

  /** \brief Names of the files that are written, with what each is called. */
  std::vector<std::pair<std::string, std::string>> files() const;
  bool writesFiles() const;
  /** \brief Whether anything is asked for. */
  bool any() const;
};

/** \brief The options, for the help. */
boost::program_options::options_description regionOptions();

/** \brief Read them. \throws UsageError */
RegionOptions readRegionOptions(const boost::program_options::variables_map& values);

} // namespace pcl_mrf_planes::apps
