// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/io/frame.h>

#include <filesystem>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief The frames of a folder that is a sequence as TUM RGB-D, ICL-NUIM or Redwood
 * publish them; empty for any other folder.
 *
 * - TUM: depth.txt with times and names, colours by rgb.txt or associations.txt;
 * - ICL-NUIM, TUM-compatible: associations.txt with numbers in place of times;
 * - Redwood: depth/ with numbered PNGs beside rgb/, image/ or color/.
 *
 * \param[in] folder where to look
 * \param[in] start what the names of the frames begin with
 */
std::vector<FrameSource> framesOfSequence(const std::filesystem::path& folder,
                                          const std::string& start,
                                          const ReadOptions& options);

/** \brief A frame that is one depth image.
 * \param[in] camera of its data set, or none
 * \param[in] colour picture of the same size, or empty */
FrameSource depthSource(const std::filesystem::path& file, const std::string& name,
                        const std::string& reader,
                        const std::optional<CameraModel>& camera,
                        const std::string& colour, const ReadOptions& options);

/** \brief A source whose errors have the name of the file in front. */
FrameSource sourceOf(const std::filesystem::path& file, const std::string& name,
                     const std::string& reader, std::function<Frame()> read);

/** \brief A source that cannot be read: what is wrong is said when it is its turn. */
FrameSource failingSource(const std::filesystem::path& file, const std::string& name,
                          const std::string& message);

} // namespace pcl_mrf_planes::io
