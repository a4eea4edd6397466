// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "view_frame.h"

#include <Eigen/Core>

namespace pcl_mrf_planes::viewer {

/** \brief A view of the cloud, in its frame. */
struct SensorView {
  Eigen::Vector3d position;
  Eigen::Vector3d focus;
  Eigen::Vector3d up;
  double across = 0.6; ///< tangent of half the angle that holds the cloud, sideways
  double along = 0.45; ///< the same upwards
};

/** \brief From behind the sensor, so that all is seen that it saw; a lidar's scan, which is
 * around the sensor, from above. */
SensorView sensorView(const ViewFrame& frame);

/** \brief From far along \a normal (of length 1, frame of the cloud), so that all is seen
 * and planes that stand on it are lines; the sensor's up is up, or what lies ahead of it
 * where it looks along the normal. */
SensorView viewAlong(const ViewFrame& frame, const Eigen::Vector3d& normal);

/** \brief The same down the sensor's own up. */
SensorView viewFromAbove(const ViewFrame& frame);

} // namespace pcl_mrf_planes::viewer
