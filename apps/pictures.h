// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/image.h>
#include <pcl_mrf_planes/organized_points.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl_mrf_planes::apps {

using io::Colour;

/** \brief A picture, row by row from the top. */
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Colour> pixels;

  Picture() = default;
  Picture(int w, int h, Colour colour)
  : width(w)
  , height(h)
  , pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), colour)
  {}
};

/** \brief Points between two panels of an overlay. */
constexpr int PANEL_GAP = 4;

/** \brief The three panels of the paper's figures: the colours (without any: shading by
 * the surface's tilt), depth from near (red) to far (blue), and the labels over the
 * colours. Side by side; one below the other when the image is over twice as wide as
 * high. Invalid points are black in the panel of depth.
 *
 * \param[in] points the cloud in the sensor frame
 * \param[in] colours one for each point, or none
 * \param[in] labels one for each point
 */
Picture overlay(const OrganizedPoints& points, const std::vector<Colour>& colours,
                const pcl::PointCloud<pcl::Label>& labels);

/** \brief The first panel of overlay(): the colours, or the shading in their place. */
Picture sight(const OrganizedPoints& points, const std::vector<Colour>& colours);

/** \brief The last panel of overlay(): labels over the colours. */
Picture labelPanel(const OrganizedPoints& points, const std::vector<Colour>& colours,
                   const pcl::PointCloud<pcl::Label>& labels);

/** \brief A picture above another, with a gap between them. */
Picture stack(const Picture& above, const Picture& below);

/** \brief The cloud in the frame of its sensor. */
OrganizedPoints inSensorFrame(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                              DepthMeasure measure);

/** \brief Write a PNG with 8 bits a channel, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writePicture(const std::string& path, const Picture& picture);

/** \brief Write a gray PNG of 8 bits a point, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeMask(const std::string& path, const std::vector<unsigned char>& mask,
               int width, int height);

/** \brief Write labels as a 16-bit gray PNG, whole or not at all.
 * \throws std::runtime_error with what is wrong and what to do */
void writeLabelImage(const std::string& path,
                     const pcl::PointCloud<pcl::Label>& labels);

} // namespace pcl_mrf_planes::apps
