// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/organized_points.h>

#include <Eigen/Core>

#include <cstddef>

namespace pcl_mrf_planes {

/// Rays through the corners of the pixels of an image, from those through the points.
///
/// A ray is p / depth: of z = 1 for cameras, of unit length for lidars. A pinhole's is linear
/// in the pixel; if samples all over the image agree with that, so is every corner's. Else a
/// corner's is the mean of what its valid pixels say, each its own ray and half a step to
/// the corner.
class CornerRays {
public:
  explicit CornerRays(const OrganizedPoints& points);

  /// Ray through the point of a valid pixel.
  Eigen::Vector3d pixelRay(int pixel) const;

  double pixelDepth(int pixel) const
  {
    return static_cast<double>(points_.depth(static_cast<std::size_t>(pixel)));
  }

  /// Ray through the upper left corner of pixel (x, y), which need not lie in the image;
  /// one of the four pixels around it must be valid. O(1)
  Eigen::Vector3d cornerRay(int x, int y) const;

private:
  void findUsualSteps();
  void fitPinhole();
  bool isValid(int x, int y) const;
  Eigen::Vector3d rayAt(int x, int y) const;
  /// Change of the ray from a pixel to the next, (1, 0) or (0, 1) away.
  Eigen::Vector3d step(int x, int y, int dx, int dy) const;

  const OrganizedPoints& points_;
  Eigen::Vector3d usual_step_[2]; ///< right and down, where a pixel has no neighbour
  bool is_pinhole_ = false;
  Eigen::Matrix<double, 3, 3> pinhole_; ///< ray of (1, x, y), pixels
};

} // namespace pcl_mrf_planes
