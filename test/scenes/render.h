// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/camera.h"
#include "scenes/scene.h"
#include "scenes/sensor_noise.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_mrf_planes::scenes {

/** \brief An organized picture of a scene with its ground truth.
 *
 * Row by row: pixel (u, v) has index v * width + u. Only planes that show in at least
 * one valid pixel are listed, in the order of the scene.
 */
struct SceneFrame {
  int width = 0;
  int height = 0;
  std::vector<float> x, y, z;          ///< metres, sensor frame; NaN where invalid
  std::vector<std::uint8_t> r, g, b;   ///< shaded colour, for pictures only
  std::vector<std::uint16_t> labels;   ///< 0: no plane or invalid, k: planes[k - 1]
  std::vector<Eigen::Vector4d> planes; ///< a b c d, sensor frame, unit normal, d >= 0
  Camera camera;                       ///< the sensor and its pose

  std::size_t size() const { return labels.size(); }
  bool valid(std::size_t pixel) const { return z[pixel] == z[pixel]; }

  /** \brief Pixels of each label; entry 0 counts all without a plane. */
  std::vector<std::size_t> labelCounts() const;
};

/** \brief Take a picture.
 * \param[in] scene what is there
 * \param[in] camera who looks; NoiseKind::KINECT asks for a pinhole
 * \param[in] noise what the sensor does to the depth
 * \param[in] seed the same seed gives the same picture
 * \throws std::invalid_argument for an empty image or Kinect noise without a pinhole
 */
SceneFrame render(const Scene& scene, const Camera& camera,
                  const SensorNoise& noise = SensorNoise::none(),
                  std::uint64_t seed = 0);

} // namespace pcl_mrf_planes::scenes
