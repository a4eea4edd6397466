// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "screen.h"
#include "session.h"

#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::viewer {

/** \brief Puts what a session has onto the parts of a screen. */
class SessionPicture {
public:
  SessionPicture(const Session& session, Screen& screen)
  : session_(session)
  , screen_(screen)
  {}

  /** \brief Place the parts and fill them; the sliders are not among them.
   * \param[in] coarse only a quarter of the points, for the sake of speed */
  void compose(bool coarse);

  /** \brief Look from where the sensor was, at what is seen now. */
  void lookFromSensor();

  /** \brief Look at the front of the selected plane; down on all if none is. */
  void facePlane();

  /** \brief Whether all points are drawn. */
  bool isFull() const { return stride_ == 1; }

  /** \brief Which points are seen on the left, those that can be picked. */
  const std::vector<bool>& shownPoints() const { return left_.shown; }

  /** \brief The points where they are seen on the left. */
  Cloud::ConstPtr shownCloud() const { return cloudOf(session_.main()); }

private:
  Props view(const SegmentedView& result, const std::vector<std::uint32_t>& classes,
             const ViewSettings& settings, PointColours& colours) const;
  Cloud::ConstPtr cloudOf(const SegmentedView& result) const;
  float pointSize() const;
  Layout layout() const;
  void drawLeft();
  void drawRight();
  void drawPanels();
  Props texts() const;

  const Session& session_;
  Screen& screen_;
  PointColours left_;
  int stride_ = 1; ///< of the points that are drawn
};

} // namespace pcl_mrf_planes::viewer
