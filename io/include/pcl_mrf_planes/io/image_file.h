// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/io/image.h>

#include <string>

namespace pcl_mrf_planes::io {

/** \brief Read a gray PNG of 16 bits a point; no gamma or colour profile is applied.
 *
 * \param[in] path the file
 * \param[in] what what such pictures are called in messages, "depth images"
 * \throws std::runtime_error with what is wrong and what to do, without the file's name
 */
PCL_MRF_PLANES_EXPORT Image16 readGrayPng(const std::string& path, const char* what);

/** \brief Order of the two bytes of a point of more than 8 bits. */
enum class ByteOrder { BIG_ENDIAN_FIRST, LITTLE_ENDIAN_FIRST };

/** \brief Read a binary PGM (P5) of 8 or 16 bits a point.
 *
 * \param[in] path the file
 * \param[in] order the most significant byte comes first in the standard; not so in the
 *            raw dumps of NYU Depth V2
 * \param[out] maximum what the header gives as largest value
 * \throws std::runtime_error as readGrayPng()
 */
PCL_MRF_PLANES_EXPORT Image16 readPgm(const std::string& path, ByteOrder order,
                                      int* maximum = nullptr);

/** \brief Read an uncompressed 8-bit Sun raster file, as SegComp has them.
 * \throws std::runtime_error as readGrayPng() */
PCL_MRF_PLANES_EXPORT Image16 readSunRaster(const std::string& path);

/** \brief Read a colour picture: PNG, JPEG or binary PPM.
 * \throws std::runtime_error as readGrayPng() */
PCL_MRF_PLANES_EXPORT ColourImage readColourImage(const std::string& path);

} // namespace pcl_mrf_planes::io
