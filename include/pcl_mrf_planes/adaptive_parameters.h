// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/export.h>

namespace pcl_mrf_planes {

/** \brief Values of Method::ADAPTIVE; lengths in metres, sizes in points of the image.
 *
 * "sigma" is the noise that is estimated from the cloud itself, for a plane of the size in
 * question: correlated noise makes a wall deviate more from its plane than a small tile
 * from its own.
 */
struct PCL_MRF_PLANES_EXPORT AdaptiveParameters {
  /// Every so many-th point of every so many-th row is segmented, the others take labels
  /// from around them; 1 (all) to 8. min_points and min_evidence count sampled points.
  int sampling = 1;
  /// A step so long that fewer points than this would be left is made shorter; 0 to 1e9.
  int least_samples = 0;

  /// \name Tiles of several sizes
  ///@{
  int levels = 4;              ///< tile sides 4, 8, 16, ... points; 2 to 8
  int smallest_level = 0;      ///< tiles below this level are not used; 0 to levels - 1
  double tile_tolerance = 2.0; ///< rms distance that a tile may have, sigmas, > 0
  double min_fill = 0.75;      ///< share of valid points that a tile needs, 0 to 1
  ///@}

  /// \name Noise
  ///@{
  bool estimate_noise = true;     ///< sigma from the cloud itself; false: from noise
  double noise_percentile = 0.5;  ///< of the tiles' rms distances at one depth, 0 to 1
  double growth_percentile = 0.4; ///< of rms(tile) / rms(its quarters), 0 to 1
  double max_growth = 1.5;        ///< largest growth for a doubling of the side, >= 1
  double long_range = 2.0; ///< sigma of large planes over the largest tile's, where the
                           ///< noise is correlated, >= 1
  double flatness = 0.012; ///< a plane may bend by this share of its extent, >= 0,
  double max_flatness = 0.002;     ///< but by no more than this, metres, >= 0
  double flatness_noise = 0.00115; ///< of the points that allow all of it, metres, >= 0
  double quiet_flatness =
      0.55;                ///< share of it that is left without noise, 0 to 1; 1: off
  double min_sigma = 2e-5; ///< least sigma at 1 m, growing with distance, metres, > 0
  int local_reach = 2;     ///< window of the local noise, tiles each way, 0 to 16
  double local_percentile = 0.25; ///< of the tiles' rms in that window, 0 to 1
  double max_local = 4.0;         ///< local noise over the cloud's, at most, >= 1
  ///@}

  /// \name Merging
  ///@{
  double merge_tolerance = 4.0;  ///< deviation of the smaller part, sigmas, > 0
  double region_tolerance = 2.0; ///< rms distance that a plane may have, sigmas, > 0
  double accept_tolerance = 2.0; ///< the same after labelling, sigmas, > 0
  int min_points =
      60; ///< smallest plane and smallest part of one, points of independent
          ///< noise, >= 1: correlated noise asks for more of them
  /// Points of independent noise times ln(width / rms distance) that a plane needs: what
  /// its equation saves in the description of its points. >= 0
  double min_evidence = 500.0;
  bool join_coplanar = true;   ///< parts of one plane behind an occluder share a label
  double join_tolerance = 2.0; ///< merge_tolerance of parts that do not touch, > 0
  double join_gap = 2.0;       ///< widest gap over the side of the smaller part, >= 0
  double join_seen = 0.05; ///< share of the way between them that may be off the plane
  bool join_over_occluders = true; ///< what stands in front does not separate parts
  ///@}

  /// \name Curved surfaces
  ///@{
  int fan_parts =
      2; ///< so many small planes in a row are a curved surface, >= 2; 0: off
  double fan_angle = 24.0; ///< largest crease in such a row, degrees
  /// Planes above this share of the points are no facets; three times as large ones may be
  /// if they bend themselves. 0 to 1
  double fan_share = 0.003;
  double fan_border = 0.5; ///< common border over the side of the smaller part, >= 0
  double fan_gap = 3.0;    ///< step across a smooth border, sigmas, >= 0
  /// A plane no larger than such is part of a curved surface, too, where so much of its
  /// border lies in such creases, which turn in more than one direction; share, 0 to 2;
  /// above 1: off
  double fan_ring = 0.9;
  /// Turn of the normal, by a quadric, that makes a region curved, degrees, times the root
  /// of the share of the variance that the quadric explains; 720: off
  double bend_angle = 14.0;
  ///@}

  /// \name Random field
  ///@{
  int support_reach = 1; ///< a plane competes so far from its cells, 4 points; 1 to 512
  double none_cost = 3.0; ///< data cost of "no plane", sigmas, > 0
  double label_change =
      1.5; ///< price of a label change on a smooth surface, sigmas, >= 0
  double step_sigmas = 6.0; ///< depth step over which that price falls, sigmas, > 0
  double min_weight = 0.15; ///< share of the price that is left across a step, 0 to 1
  int passes = 1; ///< over the points, down the image and up again; 0 to 100000
  int rounds = 2; ///< of labelling and refitting: the last of points, those before of
                  ///< cells of 4x4 points; 1 to 10
  ///@}
};

} // namespace pcl_mrf_planes
