// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/image.h>

#include <cstddef>
#include <string>

namespace pcl_mrf_planes::io {

/** \brief Header of a binary PGM or PPM. */
struct NetpbmHeader {
  int width = 0;
  int height = 0;
  int maximum = 0;
  std::size_t size = 0; ///< bytes of the header
};

/** \brief Read the header of a P5 or P6 file: numbers apart by blanks, comments from # to
 * the end of the line, one blank before the points (netpbm's pgm(5)).
 * \throws std::runtime_error with what is wrong, without the file's name */
NetpbmHeader parseNetpbmHeader(const std::string& start);

/** \brief Read a binary PPM of 8 bits a channel.
 * \throws std::runtime_error with what is wrong, without the file's name */
ColourImage readPpm(const std::string& path);

} // namespace pcl_mrf_planes::io
