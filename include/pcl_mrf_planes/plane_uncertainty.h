// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>
#include <pcl_mrf_planes/noise_model.h>
#include <pcl_mrf_planes/organized_points.h>
#include <pcl_mrf_planes/parameters.h>
#include <pcl_mrf_planes/plane.h>
#include <pcl_mrf_planes/plane_regions.h>
#include <pcl_mrf_planes/sensor_pose.h>

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes {

/** \brief How far the parameters of a plane may be off, for a filter or a pose graph.
 *
 * An error turns the normal to n + alpha t1 + beta t2 and moves the plane by gamma at the
 * centroid of its points, or the offset d by delta, which is the same to first order: large
 * turns about a far origin are best told from the centroid.
 */
struct PCL_MRF_PLANES_EXPORT PlaneUncertainty {
  /// False where the points do not determine a plane: fewer than four, on a line, or
  /// spread less than twice their rms distance. The diagonals are infinite then.
  bool valid = false;
  /// Least-squares plane of the points off the border of the region: where surfaces meet,
  /// some points of the other one carry the label. Of all points where those are few.
  Plane plane;
  Eigen::Matrix<double, 3, 2> basis; ///< unit tangents t1, t2
  Eigen::Vector3d centroid; ///< of these points, metres; the plane goes through it
  /// Covariance of (alpha, beta, gamma), gamma being the distance of the plane from the
  /// centroid: rad^2, rad m, m^2. Large turns do least harm to this form.
  Eigen::Matrix3d at_centroid;
  /// Covariance of (alpha, beta, delta): rad^2, rad m, m^2. The form for manifolds.
  Eigen::Matrix3d minimal;
  /// Covariance of (a, b, c, d), of rank 3: the length of (a, b, c) is known.
  Eigen::Matrix4d covariance;
  /// Expected error of (a, b, c, d), in the mean of many frames, too: noise along the ray
  /// turns the planes of oblique surfaces. 0 where it is over d / 10: rays hardly meet it.
  Eigen::Vector4d bias = Eigen::Vector4d::Zero();
  /// Points that tell as much as one with independent noise; 1 for white noise. The
  /// covariances hold that, and more in directions in which blocks of the region are off
  /// together by more than it explains (points of other surfaces).
  double points_per_independent = 1.0;

  /** \brief The plane less its bias. */
  Plane unbiased() const;

  /** \brief Squared Mahalanobis distance of \a other from this plane less its bias;
   * chi-square with three degrees of freedom if \a other is the true plane: 95 % below
   * 7.815. */
  double squaredDistance(const Plane& other) const;
};

/** \brief Where the noise of a point along its plane's normal is taken from. */
struct PCL_MRF_PLANES_EXPORT UncertaintyNoise {
  bool stated = false; ///< true: from model; false: from the distances of the points
  NoiseModel model;    ///< sigma of the depth, along the ray

  /** \brief The noise that the user named, where the default profile was given one. */
  static UncertaintyNoise of(const Parameters& parameters);
};

/** \brief Uncertainty of each region's plane from the noise and the spread of its points.
 *
 * The plane of least squares moves by A^-1 sum w_i e_i with w_i = (u_i, v_i, 1) in the
 * plane, A = sum w_i w_i^t, and e_i the noise along the normal, sigma_i times the depth's
 * share along the normal. Its covariance is A^-1 B A^-1 with B = k sum w_i w_i^t e_i^2: the
 * "sandwich" of White, "A Heteroskedasticity-Consistent Covariance Matrix Estimator",
 * Econometrica 48(4), 1980. k allows for noise that neighbours share: the variance of sums
 * over blocks of the image over what independent noise would give, pooled over all
 * regions, and drawn towards a region's own value by its blocks (cluster-robust, Liang and
 * Zeger, Biometrika 73, 1986). Deviations of a surface from flatness count as noise.
 *
 * Points along the border of a region are left out where 60 others determine the plane: a
 * region of the default profile has a few that lie on the surface beyond, off to one side,
 * and they do more to its plane than noise does. So PlaneUncertainty::plane is not quite
 * the region's, and the better one; of Method::PAPER's regions, whose planes are made of
 * tiles, it may be far from it.
 * O(points)
 */
PCL_MRF_PLANES_EXPORT std::vector<PlaneUncertainty>
planeUncertainties(const OrganizedPoints& points,
                   const std::vector<PlaneRegion>& regions,
                   const UncertaintyNoise& noise = UncertaintyNoise());

/** \brief The same uncertainty in the frame of the cloud. */
PCL_MRF_PLANES_EXPORT PlaneUncertainty inCloudFrame(const PlaneUncertainty& uncertainty,
                                                    const SensorPose& pose);

} // namespace pcl_mrf_planes
