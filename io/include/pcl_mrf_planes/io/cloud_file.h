// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <string>

namespace pcl_mrf_planes::io {

/** \brief How the points of a PCD file are stored; numbered as PCL numbers them. */
enum class PcdFormat { ASCII = 0, BINARY = 1, BINARY_COMPRESSED = 2 };

/** \brief ascii, binary or binary_compressed. */
PCL_MRF_PLANES_EXPORT const char* formatName(PcdFormat format);

/** \brief Columns and rows; zero by zero: not stated. */
struct PCL_MRF_PLANES_EXPORT ImageSize {
  int width = 0;  ///< columns
  int height = 0; ///< rows

  /// Whether there are columns and rows.
  bool stated() const { return width > 0 && height > 0; }
  /// Their product.
  std::size_t points() const
  {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

/** \brief An organized cloud with all its fields, as it stands in a file. */
struct PCL_MRF_PLANES_EXPORT CloudFile {
  pcl::PCLPointCloud2 cloud; ///< all fields; coordinates in metres
  Eigen::Vector4f origin = Eigen::Vector4f::Zero(); ///< of the sensor, metres
  /// Of the sensor: turns its axes into those of the cloud.
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  PcdFormat format = PcdFormat::BINARY; ///< as it was read
};

/** \brief Read an organized PCD file of any format, all fields kept.
 * \param[in] path the file
 * \param[in] size rows and columns of a file that states a single row
 * \throws std::runtime_error with the file's name, what is wrong and what to do
 */
PCL_MRF_PLANES_EXPORT CloudFile readOrganizedCloud(const std::string& path,
                                                   ImageSize size = {});

/** \brief Write a PCD file, whole or not at all, the sensor pose to the last bit.
 * \throws std::runtime_error with what is wrong and what to do
 */
PCL_MRF_PLANES_EXPORT void writeCloud(const std::string& path, const CloudFile& file,
                                      PcdFormat format);

} // namespace pcl_mrf_planes::io
