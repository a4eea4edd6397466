// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/frame.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief The frames of one file: several of NYU's labeled set, else one.
 *
 * \param[in] file any file
 * \param[in] start what the names of the frames begin with
 * \param[in] named whether the user named it: then it is a frame, even if it cannot be
 *            read; in a folder files that are no frames give none
 */
std::vector<FrameSource> framesOfFile(const std::filesystem::path& file,
                                      const std::string& start, bool named,
                                      const ReadOptions& options);

} // namespace pcl_mrf_planes::io
