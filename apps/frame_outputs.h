// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "batch_options.h"
#include "options.h"
#include "segmented_cloud.h"

#include <pcl_mrf_planes/io/frame.h>

#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Files to write for one frame; empty: not wanted. */
struct OutputFiles {
  std::string cloud;
  std::string models;
  std::string label_image;
  std::string overlay;
  std::string masks; ///< a folder
  std::string ply;
  std::string truth;
  std::string figure;
};

/** \brief Those that the options of a single frame name. */
OutputFiles outputsOf(const Options& options);

/** \brief Those of a frame of a batch. */
OutputFiles outputsOf(const std::string& frame_name, const BatchOptions& options);

/** \brief Before the work: an output that cannot be written is found early.
 * \throws std::runtime_error with what to do */
void checkOutputs(const OutputFiles& files);

/** \brief Whether all of them are there. Truth is not asked for: not all frames have it.
 */
bool outputsExist(const OutputFiles& files);

/** \brief A frame and all that is known of it. */
struct SegmentedFrame {
  const io::FrameSource& source;
  const io::Frame& frame;
  const pcl::PointCloud<pcl::PointXYZ>& cloud;
  const SegmentedCloud& result;
};

/** \brief Write the files, each whole or not at all, the JSON last: where it is, all are.
 * \throws std::runtime_error with what is wrong and what to do */
void writeOutputs(const OutputFiles& files, const SegmentedFrame& segmented,
                  const Options& options);

} // namespace pcl_mrf_planes::apps
