// SPDX-License-Identifier: BSD-3-Clause
//
// Plane after plane by pcl::SACSegmentation, as PCL's tutorial on extracting indices
// does it: the largest plane of what is left, until little is left. The planes are found
// on a thinned cloud and then claim points of the full one, the first plane first.
#include "image_parts.h"
#include "peer_list.h"

#include <pcl/filters/voxel_grid.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr std::uint16_t MAX_PLANES = 1000;
constexpr int MAX_FAILURES = 3; // planes in a row without a part that is large enough

/// The cloud that planes are found on.
struct ThinCloud {
  Cloud::Ptr cloud{new Cloud};
  std::vector<std::size_t> pixels; ///< of each point; none after a voxel grid
};

ThinCloud byVoxels(const Cloud::ConstPtr& cloud, float leaf)
{
  ThinCloud thin;
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.filter(*thin.cloud);
  return thin;
}

ThinCloud byStride(const Cloud& cloud, std::size_t stride)
{
  ThinCloud thin;
  for (std::size_t row = 0; row < cloud.height; row += stride)
    for (std::size_t column = 0; column < cloud.width; column += stride) {
      const std::size_t i = row * cloud.width + column;
      if (!std::isfinite(cloud[i].z))
        continue;
      thin.cloud->push_back(cloud[i]);
      thin.pixels.push_back(i);
    }
  return thin;
}

class SequentialRansac {
public:
  SequentialRansac(const Cloud::ConstPtr& cloud, const Values& values)
  : cloud_(*cloud)
  , threshold_(values.at("threshold"))
  , min_points_(values.at("min_points"))
  , connected_(values.at("connected") != 0.0)
  , labels_(cloud->size(), 0)
  {
    const double leaf = values.at("leaf"), stride = values.at("stride");
    thin_ = leaf > 0.0 ? byVoxels(cloud, static_cast<float>(leaf))
                       : byStride(*cloud, static_cast<std::size_t>(stride));
    points_a_sample_ = leaf > 0.0 ? 1.0 : stride * stride;
    pool_.reset(new pcl::Indices(thin_.cloud->size()));
    for (std::size_t i = 0; i < pool_->size(); ++i)
      (*pool_)[i] = static_cast<pcl::index_t>(i);
    least_left_ = values.at("rest") * static_cast<double>(pool_->size());
    segmentation_.setOptimizeCoefficients(true);
    segmentation_.setModelType(pcl::SACMODEL_PLANE);
    segmentation_.setMethodType(pcl::SAC_RANSAC);
    segmentation_.setMaxIterations(static_cast<int>(values.at("iterations")));
    segmentation_.setDistanceThreshold(threshold_);
  }

  Labels run()
  {
    while (planes_ < MAX_PLANES && pool_->size() > 3 &&
           static_cast<double>(pool_->size()) > least_left_)
      if (!extractPlane())
        break;
    return std::move(labels_);
  }

private:
  bool extractPlane()
  {
    pcl::PointIndices inliers;
    pcl::ModelCoefficients plane;
    segmentation_.setInputCloud(thin_.cloud);
    segmentation_.setIndices(pool_);
    segmentation_.segment(inliers, plane);
    const double points =
        points_a_sample_ * static_cast<double>(inliers.indices.size());
    if (inliers.indices.empty() || points < min_points_)
      return false;
    const bool found = claim(membersOf(plane));
    // Without a part that is large enough the same plane would come again.
    if (connected_ && found)
      dropLabelled();
    else
      drop(inliers.indices);
    failures_ = found ? 0 : failures_ + 1;
    return failures_ < MAX_FAILURES;
  }

  std::vector<std::uint8_t> membersOf(const pcl::ModelCoefficients& plane) const
  {
    const Eigen::Vector4f model(plane.values.data());
    const auto limit = static_cast<float>(threshold_);
    std::vector<std::uint8_t> members(cloud_.size(), 0);
    for (std::size_t i = 0; i < cloud_.size(); ++i) // NaN is within no limit
      members[i] =
          labels_[i] == 0 &&
          std::abs(cloud_[i].getVector3fMap().dot(model.head<3>()) + model[3]) <= limit;
    return members;
  }

  /// Labels the points of a plane, or each connected part of them.
  bool claim(const std::vector<std::uint8_t>& members)
  {
    if (connected_) {
      const auto parts =
          connectedParts(members, cloud_.width, static_cast<std::size_t>(min_points_));
      for (const std::vector<std::size_t>& part : parts) {
        ++planes_;
        for (const std::size_t i : part)
          labels_[i] = planes_;
      }
      return !parts.empty();
    }
    ++planes_;
    for (std::size_t i = 0; i < members.size(); ++i)
      if (members[i] != 0)
        labels_[i] = planes_;
    return true;
  }

  void drop(const pcl::Indices& inliers)
  {
    pcl::IndicesPtr rest(new pcl::Indices);
    std::set_difference(pool_->begin(), pool_->end(), inliers.begin(), inliers.end(),
                        std::back_inserter(*rest));
    pool_ = rest;
  }

  void dropLabelled()
  {
    pcl::IndicesPtr rest(new pcl::Indices);
    for (const pcl::index_t i : *pool_)
      if (labels_[thin_.pixels[static_cast<std::size_t>(i)]] == 0)
        rest->push_back(i);
    pool_ = rest;
  }

  const Cloud& cloud_;
  double threshold_;
  double min_points_;
  bool connected_;
  Labels labels_;
  ThinCloud thin_;
  double points_a_sample_ = 1.0;
  double least_left_ = 0.0;
  pcl::IndicesPtr pool_; ///< ascending: points of the thin cloud that are left
  std::uint16_t planes_ = 0;
  int failures_ = 0;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation_{false}; // false: a fixed seed
};

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  const Stopwatch watch;
  Labels labels = SequentialRansac(cloud, values).run();
  milliseconds = watch.milliseconds();
  return labels;
}

} // namespace

Peer makePclRansac()
{
  // Lengths in metres. leaf: of the voxel grid, 0: every stride-th row and column; rest:
  // share of the points at which it ends; min_points: of a plane, in the full cloud;
  // connected: 1: each connected part of the image is a plane of its own (no leaf).
  return {"pcl_ransac",
          "pcl::SACSegmentation plane by plane, RANSAC",
          {{"published",
            "PCL's tutorial on extracting indices",
            {{"leaf", 0.01},
             {"stride", 1},
             {"iterations", 1000},
             {"threshold", 0.01},
             {"rest", 0.3},
             {"min_points", 0},
             {"connected", 0}}},
           {"tuned",
            "best of tune_peers.py",
            {{"leaf", 0},
             {"stride", 2},
             {"iterations", 1000},
             {"threshold", 0.005},
             {"rest", 0},
             {"min_points", 500},
             {"connected", 1}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
