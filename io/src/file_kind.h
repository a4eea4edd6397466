// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl_mrf_planes::io {

/** \brief What a file is by its first bytes; by its ending only where those are missing
 * or damaged. */
enum class FileKind {
  PCD,
  PLY,
  PCLZF,
  DEPTH_PNG, ///< gray, 16 bits
  OTHER_PNG,
  DEPTH_PGM, ///< more than 8 bits
  OTHER_PGM,
  SUN_RASTER,
  HDF5,
  TEXT_DEPTH, ///< numbers as text in a file *.depth
  PERCEPTRON,
  COMPRESSED, ///< by gzip, compress or zip
  OTHER
};

/** \brief Look into a file.
 * \throws std::runtime_error when it cannot be read, without its name */
FileKind fileKind(const std::string& path);

} // namespace pcl_mrf_planes::io
