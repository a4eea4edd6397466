// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/cloud_file.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <istream>
#include <string>

namespace pcl_mrf_planes::io {

/** \brief Header of a PCD file whose claims were held against the file's size. */
struct PcdHeader {
  pcl::PCLPointCloud2 cloud; ///< fields and size; data has its length, all zero
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  PcdFormat format = PcdFormat::ASCII;
  int version = 0;              ///< PCL's number for the version of the format
  std::uint64_t body_start = 0; ///< bytes from the start of the file
  std::uint64_t body_size = 0;  ///< bytes that the points take; ascii: all that is left

  std::uint64_t points() const
  {
    return static_cast<std::uint64_t>(cloud.width) * cloud.height;
  }
};

/** \brief Read the header by pcl::PCDReader::readHeader, which allocates whatever the
 * header claims: so the claims are checked first.
 *
 * \param[in] stream the file, from its start, in binary mode
 * \param[in] file_size bytes
 * \param[in] size rows and columns to take for a file that states none; zero: as stated
 * \throws std::runtime_error with what is wrong and what to do, without the file's name
 */
PcdHeader readPcdHeader(std::istream& stream, std::uint64_t file_size, ImageSize size);

} // namespace pcl_mrf_planes::io
