// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segmented_view.h"
#include "view_settings.h"

#include <pcl_mrf_planes/io/frame.h>

#include <cstddef>
#include <functional>
#include <future>
#include <string>

namespace pcl_mrf_planes::viewer {

/** \brief By what a frame is segmented. */
struct Choice {
  Parameters parameters;
  Profile profile = Profile::DEFAULT; ///< name of the parameters' profile
  Comparison comparison = Comparison::OFF;
};

/** \brief A frame with all that is worked out before it is seen. */
struct SegmentedFrame {
  ViewFrame frame;
  SegmentedView main;
  SegmentedView other; ///< empty without a comparison
};

/** \brief "paper", "fast" or "default". */
std::string profileName(Profile profile);

SegmentedView segmentMain(const ViewFrame& frame, const Choice& choice);

/** \brief What stands beside it. */
SegmentedView segmentOther(const ViewFrame& frame, Comparison comparison);

/** \brief Read and segment a frame.
 * \throws std::runtime_error with the input's name, what is wrong and what to do */
SegmentedFrame segmentFrame(const io::FrameSource& source, const Choice& choice);

/** \brief Works on one frame in a thread of its own while another one is seen. */
class FrameAhead {
public:
  using Work = std::function<SegmentedFrame()>;

  /** \brief Begin with frame \a index; waits for the end of what was begun before. */
  void begin(std::size_t index, Work work);

  /** \brief Give up what was begun, as after a change of what it goes by. */
  void forget();

  bool isFor(std::size_t index) const { return work_.valid() && index_ == index; }

  /** \brief Wait for the frame and hand it over, or throw what its work threw. */
  SegmentedFrame take() { return work_.get(); }

private:
  std::future<SegmentedFrame> work_;
  std::size_t index_ = 0;
};

} // namespace pcl_mrf_planes::viewer
