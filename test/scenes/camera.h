// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <variant>

namespace pcl_mrf_planes::scenes {

/** \brief Pinhole camera: x right, y down, z forward; depth is z. */
struct Pinhole {
  double fx, fy; ///< focal lengths, pixels, > 0
  double cx, cy; ///< principal point, pixels; (0, 0) is the centre of the first pixel

  /** \brief A Kinect: f = 525 at 640 columns, scaled with \a width, centred. */
  static Pinhole kinect(int width, int height);
};

/** \brief Rows and columns of equal angles: x forward, y left, z up; depth is range.
 *
 * Pixel (u, v) looks along the centre of its cell, so that a full turn has no column
 * twice. Azimuth grows to the left, elevation upwards, both in radians.
 */
struct Spherical {
  double azimuth_left, azimuth_right; ///< outer borders of the first and last column
  double elevation_top, elevation_bottom; ///< outer borders of the first and last row

  /** \brief A rotating lidar: a full turn, 22.5 degrees up and down (Ouster OS1). */
  static Spherical lidar();
};

/** \brief A sensor somewhere in the world. */
struct Camera {
  int width = 640;  ///< pixels, >= 1
  int height = 480; ///< pixels, >= 1
  std::variant<Pinhole, Spherical> projection = Pinhole::kinect(640, 480);
  Eigen::Isometry3d to_world = Eigen::Isometry3d::Identity(); ///< sensor to world frame

  /** \brief Direction of an image point in the sensor frame: z = 1 for Pinhole, unit
   * length for Spherical; times the depth it is the point. */
  Eigen::Vector3d direction(double u, double v) const;

  bool isPinhole() const { return std::holds_alternative<Pinhole>(projection); }

  /** \brief Same pose, another size: a pinhole is replaced by Pinhole::kinect. */
  void resize(int new_width, int new_height);

  /** \brief Same place, upright, same heading, as a rotating lidar. */
  void makeLidar(int new_width, int new_height,
                 const Spherical& angles = Spherical::lidar());
};

/** \brief Kinect at \a position looking at \a target, image upright; world z is up.
 * \param[in] position metres
 * \param[in] target metres, not straight above or below the position
 */
Camera lookAt(const Eigen::Vector3d& position, const Eigen::Vector3d& target);

} // namespace pcl_mrf_planes::scenes
