// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/image.h>

#include <string>

namespace pcl_mrf_planes::io {

/** \brief Read any PNG as a picture in colour.
 * \throws std::runtime_error with what is wrong and what to do, without the file's name
 */
ColourImage readColourPng(const std::string& path);

} // namespace pcl_mrf_planes::io
