// SPDX-License-Identifier: BSD-3-Clause
/** \file Planes of point clouds by robust statistics, after Araujo and Oliveira, "A robust
 * statistics approach for plane detection in unorganized point clouds", Pattern
 * Recognition 100 (2020): our own implementation of what the paper describes, neither the
 * authors' program nor that of Open3D (PointCloud::DetectPlanarPatches), which has it too.
 */
#pragma once

#include "peer.h"

#include <Eigen/Core>

#include <vector>

namespace pcl_mrf_planes::benchmarks::patches {

/** \brief Angles in degrees. The defaults are those of Open3D, and of the paper. */
struct Parameters {
  int neighbours = 30;           ///< of a point, for its normal and for growing
  double min_share = 0.001;      ///< points of a patch, share of the cloud
  int min_points = 10;           ///< of a patch at least
  double normal_variance = 60.0; ///< largest spread of the normals of a patch
  double coplanarity = 75.0;     ///< least angle of a patch's diagonal to its normal
  double outlier_ratio = 0.75;   ///< largest share of points off the plane at the start
  double min_edge = 0.01;        ///< of a patch, share of the longest side of the cloud
};

/** \brief The valid points of a cloud with their normals and nearest neighbours. */
struct PointSet {
  std::vector<std::size_t> places;      ///< of the points in the cloud
  std::vector<Eigen::Vector3f> points;  ///< metres
  std::vector<Eigen::Vector3f> normals; ///< unit length, to the sensor
  std::vector<int> neighbours;          ///< \a count of each point
  int count = 0;

  std::size_t size() const { return points.size(); }
};

/** \brief Normals by least squares over the nearest neighbours. */
PointSet makePointSet(const Cloud& cloud, const Parameters& parameters);

/** \brief A plane with the points that it has, and how far off others may be. */
struct Patch {
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float most_distance = 0.0f; ///< of an inlier, metres
  float least_cosine = 1.0f;  ///< between the normal of an inlier and that of the plane
  std::vector<int> members;   ///< points of the set
  std::size_t fitted = 0;     ///< number of members when the plane was last fitted

  float distance(const Eigen::Vector3f& point) const
  {
    return std::abs(normal.dot(point - centre));
  }
  float cosine(const Eigen::Vector3f& other) const
  {
    return std::abs(normal.dot(other));
  }
  bool isInlier(const PointSet& set, int point) const
  {
    const auto k = static_cast<std::size_t>(point);
    return distance(set.points[k]) < most_distance &&
           cosine(set.normals[k]) > least_cosine;
  }

  /** \brief Plane and bounds by medians over the members. */
  void fit(const PointSet& set);

  /** \brief The paper's planarity test; after fit(). Takes outliers out if it passes. */
  bool passTest(const PointSet& set, const Parameters& parameters);

  /** \brief Shorter side of the rectangle around the members, metres. */
  float shorterSide(const PointSet& set) const;
};

/** \brief Planar nodes of an octree: the smallest that the test accepts. */
std::vector<Patch> split(const PointSet& set, const Parameters& parameters);

/** \brief Let patches grow over neighbouring points and merge until nothing changes;
 * drop what stays too small. */
void growAndMerge(const PointSet& set, const Parameters& parameters,
                  std::vector<Patch>& patches);

/** \brief Labels of the points of the patches. */
Labels labelMembers(const PointSet& set, const std::vector<Patch>& patches,
                    std::size_t size);

/** \brief Labels of the points inside the boxes around the patches, which are all that
 * Open3D gives: as large as the members, as thick as the distance of an inlier. A point in
 * several goes to the nearest plane. */
Labels labelBoxes(const PointSet& set, const std::vector<Patch>& patches,
                  std::size_t size);

} // namespace pcl_mrf_planes::benchmarks::patches
