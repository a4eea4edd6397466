// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief What the command line asks for. */
struct PeerOptions {
  bool help = false;
  bool list = false;
  bool labelled_only = false;
  std::string data;
  std::string output;
  std::string label_folder; ///< empty: labels are not written
  std::vector<std::string> sets;
  std::vector<std::string> frames;
  std::vector<std::string> methods;
  std::vector<std::string> tries;
  int repeat = 3;
};

/** \brief The call was wrong. */
class UsageError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/** \brief A method with one of its settings. */
struct PeerRun {
  Peer peer;
  Setting setting;
};

/** \throws UsageError with what is wrong and what to do */
PeerOptions parseOptions(int argc, const char* const argv[]);

/** \brief The text of --help. */
std::string helpText();

/** \brief What to run, in the order of the list: the tries, or all settings of the
 * methods that are asked for.
 * \throws UsageError when a method or parameter has no such name */
std::vector<PeerRun> chooseRuns(const std::vector<Peer>& peers,
                                const PeerOptions& options);

} // namespace pcl_mrf_planes::benchmarks
