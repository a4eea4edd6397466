// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/image.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief The fields x, y and z (float or double) as a cloud with the sensor pose.
 * \throws std::runtime_error when a field is missing, has another type, or no point has
 *         three finite coordinates
 */
PCL_MRF_PLANES_EXPORT pcl::PointCloud<pcl::PointXYZ>::Ptr
coordinates(const CloudFile& file);

/** \brief Colour of every point from a field rgb or rgba; empty if there is none. */
PCL_MRF_PLANES_EXPORT std::vector<Colour> colours(const CloudFile& file);

/** \brief Label of every point from a field label of whole numbers; empty if there is
 * none. Negative ones are 0, no label. */
PCL_MRF_PLANES_EXPORT std::vector<std::uint32_t> labels(const CloudFile& file);

/** \brief The same cloud with a last field label (uint32); a field of that name is
 * dropped, and so is padding.
 * \param[in] file the cloud
 * \param[in] labels a label for each point
 */
PCL_MRF_PLANES_EXPORT CloudFile withLabels(const CloudFile& file,
                                           const pcl::PointCloud<pcl::Label>& labels);

/** \brief The same cloud with a last field confidence (float); a field of that name is
 * dropped, and so is padding.
 * \param[in] file the cloud
 * \param[in] confidence a number for each point */
PCL_MRF_PLANES_EXPORT CloudFile withConfidence(const CloudFile& file,
                                               const std::vector<float>& confidence);

} // namespace pcl_mrf_planes::io
