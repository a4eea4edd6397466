// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/program_options.hpp>

#include <set>
#include <string>

namespace pcl_mrf_planes::apps {

/** \brief Files that a batch can write for each frame beside its JSON. */
enum class FrameOutput { CLOUD, LABELS, OVERLAY, MASKS, PLY, TRUTH, FIGURE };

/** \brief What the command line says about many frames in one call. */
struct BatchOptions {
  std::string output_folder; ///< empty: one frame, no batch
  std::set<FrameOutput> outputs = {FrameOutput::LABELS};
  std::string inputs_from; ///< file with one input a line
  int jobs = 1;
  bool resume = false;
  bool list = false; ///< print the names of the frames only
  int shard = 1;     ///< 1 to shards
  int shards = 1;

  bool active() const { return !output_folder.empty() || list; }
};

/** \brief Options of a batch. */
boost::program_options::options_description batchOptions();

/** \brief What they say.
 * \throws UsageError */
BatchOptions readBatchOptions(const boost::program_options::variables_map& values);

} // namespace pcl_mrf_planes::apps
