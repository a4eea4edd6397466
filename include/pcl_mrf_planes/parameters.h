// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/adaptive_parameters.h>
#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/noise_model.h>

#include <string>

namespace pcl_mrf_planes {

/** \brief How the plane of a tile is taken from its ten sums (section IV-A). */
enum class PlaneFit {
  ALGEBRAIC, ///< smallest eigenvector of the 4x4 scatter matrix, equation (4)
  GEOMETRIC  ///< smallest eigenvector of the 3x3 covariance: exact minimiser of (3)
};

/** \brief Price of two labels on neighbouring sites (section IV-C). */
enum class Smoothness {
  POTTS,          ///< gamma when the labels differ, equation (8)
  DISSIMILARITY,  ///< plane dissimilarity, equation (9)
  HYBRID,         ///< max(|dz|, dissimilarity), equation (10)
  PREDICTED_DEPTH ///< max(|(1 - c) dz|, dissimilarity), the text before equation (10)
};

/** \brief What counts as the depth Z(i, j) of a point. */
enum class DepthMeasure {
  AUTO,         ///< RANGE if over 1 % of the points lie behind the sensor's x-y plane
  OPTICAL_AXIS, ///< z of the sensor frame: depth cameras
  RANGE         ///< distance to the sensor: rotating lidars
};

/** \brief Which chain of stages segments the cloud. */
enum class Method {
  PAPER,   ///< sections IV-A to IV-D as they stand
  ADAPTIVE ///< the same three steps made right for noise, small planes and clutter
};

/** \brief Named sets of parameter values. */
enum class Profile {
  DEFAULT, ///< the best segments: Method::ADAPTIVE
  FAST,    ///< the same on every third point of every third row, for every point
  PAPER    ///< the paper, equation by equation, with the values of its section V
};

/** \brief Every number that the segmentation depends on.
 *
 * Units are metres and points. What stands here for Method::PAPER has the values of
 * Profile::PAPER (section V of the paper where it states one).
 */
struct PCL_MRF_PLANES_EXPORT Parameters {
  Method method = Method::ADAPTIVE; ///< the chain of stages

  /** \brief Values of Method::ADAPTIVE, which takes of those below depth_measure,
   * min_inliers and min_area, and noise if it is not to estimate it. */
  AdaptiveParameters adaptive;

  /// \name Planar surface detection, section IV-A
  ///@{
  int tile_width = 40;                ///< points, 2 to 4096; section V
  int tile_height = 40;               ///< points, 2 to 4096; section V
  PlaneFit fit = PlaneFit::ALGEBRAIC; ///< of a tile, (3) and (4)
  /// A tile is kept when its rms distance is at most noise_multiplier * noise.sigma(z).
  NoiseModel noise = NoiseModel::kinect();
  double noise_multiplier = 1.0; ///< > 0; larger keeps more tiles
  double min_valid_share = 0.5; ///< share of a tile's points that must be valid, 0 to 1
  /// What counts as depth, for noise and for the energy.
  DepthMeasure depth_measure = DepthMeasure::AUTO;
  ///@}

  /// \name Merging planes, section IV-B
  ///@{
  double beta = 0.4;             ///< weight of |d_i - d_j| in (5) and (9), 1/m, >= 0
  double merge_threshold = 0.15; ///< v of (5), >= 0; larger merges more
  int max_planes = 256; ///< label planes kept (best supported first), 1 to 4096
  ///@}

  /// \name Energy, section IV-C
  ///@{
  double lambda = 0.2; ///< weight of the data term (7), 1/m, >= 0
  double tau = 0.5;    ///< distance at which (7) is cut off, metres, > 0
  Smoothness smoothness = Smoothness::HYBRID; ///< (8), (9) or (10)
  double gamma = 0.15; ///< price of a label change for Smoothness::POTTS, (8), >= 0
  ///@}

  /// \name Belief propagation, section IV-D
  ///@{
  int iterations = 5; ///< checkerboard iterations, one colour each, 0 to 100000
  /// Stop early once no message of either colour changed by more than this (energy
  /// units of (6)); negative: never.
  double convergence_tolerance = -1.0;
  bool compute_energy = false; ///< record the energy after every iteration (slower)
  ///@}

  /// \name Output
  ///@{
  int min_inliers = 0; ///< planes with fewer points are dropped, >= 0
  double min_area =
      0.0; ///< planes with a smaller area are dropped, square metres, >= 0
  ///@}

  unsigned int number_of_threads = 1; ///< 0: as many as the machine has cores

  /** \brief The values of a named profile. */
  static Parameters fromProfile(Profile profile);

  /** \brief Check every value against its range.
   * \return an empty string, or a sentence that names the parameter, its value and the
   *         range to choose from
   */
  std::string validate() const;
};

} // namespace pcl_mrf_planes
