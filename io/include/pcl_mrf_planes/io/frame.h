// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/io/camera_model.h>
#include <pcl_mrf_planes/io/cloud_file.h>
#include <pcl_mrf_planes/io/image.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pcl_mrf_planes::io {

/** \brief What a reader takes from the user; all may be left out. */
struct PCL_MRF_PLANES_EXPORT ReadOptions {
  std::optional<CameraModel> camera; ///< of depth images; wins over files beside them
  ImageSize size;                    ///< of clouds that do not state rows and columns
  bool filled_depth =
      false; ///< of NYU's labeled set: inpainted depth, not the measured
};

/** \brief One organized cloud, and what the file or its data set has beside it. */
struct PCL_MRF_PLANES_EXPORT Frame {
  CloudFile file;                    ///< the cloud with its fields and sensor pose
  std::vector<Colour> colours;       ///< for pictures, one for each point; or none
  std::vector<std::uint16_t> truth;  ///< plane of each point, 0 none; or empty
  std::optional<CameraModel> camera; ///< of a depth image
};

/** \brief A frame that can be read. */
struct PCL_MRF_PLANES_EXPORT FrameSource {
  std::string name;   ///< relative path without ending, for the results' files
  std::string input;  ///< the file, with what is meant in it
  std::string reader; ///< which of the readers of doc/inputs.md
  /// Throws std::runtime_error with the file's name, what is wrong and what to do.
  /// May be called from several threads at once.
  std::function<Frame()> read;
};

/** \brief The frames of some inputs. */
struct PCL_MRF_PLANES_EXPORT FrameList {
  std::vector<FrameSource> frames;      ///< in the order of the inputs, then by name
  std::vector<std::string> passed_over; ///< files in folders that are no frames
};

/** \brief Find the frames of files, folders, data sets and patterns.
 *
 * Kinds are told apart by content. Folders are walked with those below them; links to
 * folders are followed once. In a folder files that are no frames are passed over; a
 * file that was named must be one.
 *
 * \param[in] inputs names of files and folders, or patterns of glob(7)
 * \param[in] options what the readers need to know
 * \param[in] excluded a folder not to walk, that of the results; or empty
 * \return among several inputs one that cannot be read stays as a frame that says so
 * \throws std::runtime_error when the only input is a folder without a frame or a pattern
 *         that fits nothing, with its name and what to do
 */
PCL_MRF_PLANES_EXPORT FrameList listFrames(const std::vector<std::string>& inputs,
                                           const ReadOptions& options,
                                           const std::string& excluded = {});

} // namespace pcl_mrf_planes::io
