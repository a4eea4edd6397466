// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scenes/camera.h"
#include "scenes/random.h"
#include "scenes/scene.h"

#include <cstddef>
#include <vector>

namespace pcl_mrf_planes::scenes {

/** \brief What the sensor meets and measures, pixel by pixel, row by row. */
struct DepthImage {
  std::vector<double> depth; ///< metres along Camera::direction, NaN: nothing measured
  std::vector<int> surface;  ///< index into Scene::surfaces(), -1: nothing measured

  void invalidate(std::size_t pixel);
};

enum class NoiseKind {
  NONE,     ///< exact depth
  GAUSSIAN, ///< independent, along the ray, the same at every distance
  KINECT    ///< see addKinectNoise()
};

/** \brief Which noise, and how much. */
struct SensorNoise {
  NoiseKind kind = NoiseKind::NONE;
  double sigma = 0.01; ///< GAUSSIAN: standard deviation along the ray, metres, >= 0
  double scale =
      1.0; ///< KINECT: 1 is a real Kinect v1, 0 leaves the quantisation, >= 0
  double jitter =
      0.7; ///< KINECT: displacement at depth edges, pixels (std. dev.), >= 0
  double min_depth = 0.5; ///< KINECT: nearer points are invalid, metres
  double max_depth = 8.0; ///< KINECT: farther points are invalid, metres
  bool shadows = true;    ///< KINECT: holes where the projector's light does not reach

  static SensorNoise none() { return {}; }
  static SensorNoise gaussian(double sigma);
  static SensorNoise kinect(double scale = 1.0);
};

/** \brief Independent noise along each ray. \param[in] sigma metres, >= 0 */
void addGaussianNoise(const Camera& camera, double sigma, Random& random,
                      DepthImage& image);

/** \brief Noise of a Kinect v1, for pinhole cameras.
 *
 * In order: edges displaced sideways, shadows of the projector, range limits, noise of
 * the disparity (a little correlated between neighbours), disparity rounded to 1/8
 * pixel.
 *
 * Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor
 * Mapping Applications", Sensors 12(2):1437-1454, 2012: the random error is half a
 * disparity unit, that is a standard deviation of 1.425 mm z^2, and neighbouring levels
 * are 2.85 mm z^2 apart. With f b = 575 px x 0.075 m one level is 1/8 pixel.
 * Nguyen, Izadi and Lovell, "Modeling Kinect Sensor Noise for Improved 3D
 * Reconstruction and Tracking", 3DIMPVT 2012: lateral noise of 0.5 to 1 pixel.
 */
void addKinectNoise(const Scene& scene, const Camera& camera, const SensorNoise& noise,
                    Random& random, DepthImage& image);

} // namespace pcl_mrf_planes::scenes
