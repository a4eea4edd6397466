// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace pcl_mrf_planes::evaluation {

/** \brief The files of one frame. */
struct FrameFiles {
  std::string set;  ///< folder below the folder of the truth; empty: the folder itself
  std::string name; ///< what the frame is called
  std::string truth;
  std::string labels; ///< empty: there is no result
  std::string cloud;  ///< empty: none wanted
};

/** \brief Find NAME.SUFFIX in the folder of the truth and in the folders below it, and
 * for each NAME.png, NAME.labels.png or NAME.pcd at the same place below the folder of
 * the results.
 *
 * \param[in] suffixes without the dot in front; a file takes the first that fits
 * \param[in] clouds folder that has NAME.pcd at the same place, or empty
 * \return by set, then name; hidden files are passed over
 * \throws std::runtime_error when a folder or a cloud does not exist or there is no
 *         truth, with what to do
 */
std::vector<FrameFiles> findFrames(const std::string& truth, const std::string& labels,
                                   const std::string& clouds,
                                   const std::vector<std::string>& suffixes);

/** \brief The frames of pairs of files: truth, labels, truth, labels ...
 * \param[in] clouds folder that has NAME.pcd for a truth NAME.SUFFIX, or empty
 * \throws std::runtime_error when the folder or a cloud does not exist
 */
std::vector<FrameFiles> pairFrames(const std::vector<std::string>& files,
                                   const std::string& clouds,
                                   const std::vector<std::string>& suffixes);

} // namespace pcl_mrf_planes::evaluation
