// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

#include <limits>
#include <string>
#include <vector>

namespace pcl_mrf_planes {

/** \brief Standard deviation of a sensor's depth, sigma(z) = a + b z + c z^2.
 *
 * The paper stores "planes having low fit-error" (section IV-A) without a threshold.
 * Sensor noise grows with depth, so the threshold does too: a tile is kept while its
 * root mean square distance stays below a multiple of sigma at the tile's depth.
 */
struct PCL_MRF_PLANES_EXPORT NoiseModel {
  double a = 0.0; ///< constant part, metres
  double b = 0.0; ///< linear part, metres per metre
  double c = 0.0; ///< quadratic part, metres per square metre

  /** \brief Standard deviation in metres at depth \a z in metres (z >= 0). */
  double sigma(double z) const { return a + z * (b + z * c); }

  /** \brief The same threshold at every depth. \param[in] threshold metres, > 0 */
  static NoiseModel fixed(double threshold) { return {threshold, 0.0, 0.0}; }

  /** \brief Microsoft Kinect v1: 1.425 mm z^2.
   *
   * Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor
   * Mapping Applications", Sensors 12(2), 2012: random error proportional to z^2,
   * 1.4 mm at 1 m, 2.3 cm at 4 m.
   */
  static NoiseModel kinect() { return {0.0, 0.0, 1.425e-3}; }

  /** \brief Structured light with a floor: 1.2 mm + 1.9 mm (z - 0.4 m)^2, expanded.
   *
   * Nguyen, Izadi and Lovell, "Modeling Kinect Sensor Noise for Improved 3D
   * Reconstruction and Tracking", 3DIMPVT 2012, axial noise at small angles.
   */
  static NoiseModel structuredLight() { return {1.504e-3, -1.52e-3, 1.9e-3}; }

  /** \brief Time-of-flight cameras: 1.5 mm + 0.6 mm z^2.
   *
   * The floor is the smallest uncertainty that Corti et al., "A metrological
   * characterization of the Kinect V2 time-of-flight camera", Robotics and Autonomous
   * Systems 75, 2016, report (1.5 mm, rising to tens of millimetres); the growth is
   * that of a signal that falls with z^2, set to reach 14 mm at the range limit of 4.5
   * m.
   */
  static NoiseModel timeOfFlight() { return {1.5e-3, 0.0, 0.6e-3}; }

  /** \brief Rotating lidar: 20 mm at every range.
   *
   * Ouster OS1 data sheet: one standard deviation is 1.5 cm for strong and 3 cm for
   * middling returns.
   */
  static NoiseModel lidar() { return fixed(0.02); }

  /** \brief No rejection: every tile with a fit is kept. */
  static NoiseModel none() { return fixed(std::numeric_limits<double>::infinity()); }

  /** \brief Preset by name: kinect, structured_light, time_of_flight, lidar, none.
   * \param[in] name the preset's name
   * \param[out] model set when the name is known
   * \return false when it is not
   */
  static bool fromName(const std::string& name, NoiseModel& model);

  /** \brief The names that fromName() takes. */
  static std::vector<std::string> names();
};

} // namespace pcl_mrf_planes
