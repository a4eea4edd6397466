// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluation/label_image.h"
#include "peer.h"

#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief A cloud of a set and where its ground truth is. */
struct Frame {
  std::string set;
  std::string name;
  std::string cloud; ///< path
  std::string truth; ///< path; empty: there is none
};

/** \brief The clouds of a folder of sets: SET/NAME.pcd, with SET/NAME.gt.png,
 * NAME.faces.png or NAME.pgt.png where there is ground truth.
 * \param[in] sets the folders to read, in this order; none: all, by name
 * \throws std::runtime_error when a folder is missing
 */
std::vector<Frame> listFrames(const std::string& folder,
                              const std::vector<std::string>& sets);

/** \brief Read the cloud of a frame.
 * \throws std::runtime_error when it cannot be read or is not organized */
Cloud::Ptr readCloud(const Frame& frame);

/** \brief Read the ground truth of a frame that has it.
 * \throws std::runtime_error when it cannot be read */
evaluation::LabelImage readTruth(const Frame& frame);

} // namespace pcl_mrf_planes::benchmarks
