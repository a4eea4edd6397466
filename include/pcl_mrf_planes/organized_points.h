// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/parameters.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes {

/** \brief An organized cloud as planes of floats, in the sensor frame.
 *
 * Row by row, point (x, y) of the image at index y * width + x. The sensor is at the
 * origin, so the result does not depend on where the cloud lies in the world, and the
 * offset d of a plane turned towards the sensor is never negative. Invalid points have
 * coordinates 0 and valid 0: they add nothing to a sum and are no sites of the field.
 */
struct PCL_MRF_PLANES_EXPORT OrganizedPoints {
  int width = 0;        ///< columns of the image
  int height = 0;       ///< rows of the image
  std::vector<float> x; ///< metres, sensor frame
  std::vector<float> y; ///< metres, sensor frame
  std::vector<float> z; ///< metres, sensor frame: depth for cameras
  std::vector<std::uint8_t>
      valid; ///< 1: a measured point inside the region of interest
  /// How depth is measured; never AUTO once resolveDepthMeasure() was called.
  DepthMeasure depth_measure = DepthMeasure::OPTICAL_AXIS;

  /** \brief Points farther than this, in metres, count as invalid. */
  static constexpr float FARTHEST = 1e6f;

  /** \brief Number of points, valid or not. */
  std::size_t size() const { return valid.size(); }

  /** \brief Set the size; all points become invalid. */
  void resize(int new_width, int new_height);

  /** \brief The same without clearing: all points are to be set.
   * \return how many there are */
  std::size_t setSize(int new_width, int new_height)
  {
    width = new_width;
    height = new_height;
    const std::size_t count =
        static_cast<std::size_t>(new_width) * static_cast<std::size_t>(new_height);
    x.resize(count);
    y.resize(count);
    z.resize(count);
    valid.resize(count);
    return count;
  }

  /** \brief Store a point of the sensor frame at \a index; one that is not finite or
   * beyond FARTHEST stays invalid. */
  void set(std::size_t index, float px, float py, float pz)
  {
    // Written so that NaN and infinity fail.
    const bool good = std::abs(px) <= FARTHEST && std::abs(py) <= FARTHEST &&
                      std::abs(pz) <= FARTHEST;
    x[index] = good ? px : 0.0f;
    y[index] = good ? py : 0.0f;
    z[index] = good ? pz : 0.0f;
    valid[index] = good;
  }

  /** \brief Set the size and all points: point(i) gives the coordinates of the i-th, as
   * for set(). Memory is reused. O(points) */
  template <typename Point>
  void fill(int new_width, int new_height, const Point& point)
  {
    const std::size_t count = setSize(new_width, new_height);
    // Pointers of its own: the compiler then knows that no store moves the vectors.
    float* const xs = x.data();
    float* const ys = y.data();
    float* const zs = z.data();
    std::uint8_t* const valids = valid.data();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f p = point(i);
      // Without branches; written so that NaN and infinity fail.
      const bool good = static_cast<int>(std::abs(p.x()) <= FARTHEST) &
                        static_cast<int>(std::abs(p.y()) <= FARTHEST) &
                        static_cast<int>(std::abs(p.z()) <= FARTHEST);
      xs[i] = good ? p.x() : 0.0f;
      ys[i] = good ? p.y() : 0.0f;
      zs[i] = good ? p.z() : 0.0f;
      valids[i] = good ? 1 : 0;
    }
  }

  /** \brief The same as fill() for points in memory, x, y and z in a row, \a stride
   * numbers from one to the next (at least 3), by so many \a threads, 0 for as many as
   * there are cores. O(points) */
  void load(int new_width, int new_height, const float* first, std::size_t stride,
            unsigned int threads = 1);

  /** \brief Make the point at \a index invalid. */
  void clear(std::size_t index)
  {
    x[index] = y[index] = z[index] = 0.0f;
    valid[index] = 0;
  }

  /** \brief Depth Z(i, j) of the point at \a index in metres. */
  float depth(std::size_t index) const
  {
    if (depth_measure != DepthMeasure::RANGE)
      return z[index];
    return std::sqrt(x[index] * x[index] + y[index] * y[index] + z[index] * z[index]);
  }

  /** \brief Depths of row \a row; \a storage is used where they are not stored already.
   */
  const float* depthRow(int row, std::vector<float>& storage) const;

  /** \brief Depth of any point of the sensor frame in metres. */
  double depthOf(const Eigen::Vector3d& point) const
  {
    return depth_measure == DepthMeasure::RANGE ? point.norm() : std::abs(point.z());
  }

  /** \brief Decide AUTO from the points of every fourth row: a camera sees nothing behind
   * itself.
   * \param[in] wanted how to measure; any but AUTO is taken as it is
   * \param[in] threads 0: as many as there are cores */
  void resolveDepthMeasure(DepthMeasure wanted, unsigned int threads = 1);

  /** \brief Number of valid points. \param[in] threads 0: as many as there are cores */
  std::size_t countValid(unsigned int threads = 1) const;
};

} // namespace pcl_mrf_planes
