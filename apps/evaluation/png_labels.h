// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label_image.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <string>
#include <utility>

namespace pcl_mrf_planes::evaluation {

/** \brief Read a gray PNG of 16 bits a point; no gamma or colour profile is applied.
 * \throws std::runtime_error with what is wrong and what to do, without the file's name
 */
inline LabelImage readLabelPng(const std::string& path)
{
  io::Image16 image = io::readGrayPng(path, "label images");
  return {image.width, image.height, std::move(image.pixels)};
}

} // namespace pcl_mrf_planes::evaluation
