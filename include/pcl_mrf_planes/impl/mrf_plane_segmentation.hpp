// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/mrf_plane_segmentation.h>
#include <pcl_mrf_planes/region_contour.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl {

template <typename PointT>
void MRFPlaneSegmentation<PointT>::segment(
    std::vector<ModelCoefficients>& model_coefficients,
    std::vector<PointIndices>& inlier_indices)
{
  const bool done = run([&](const Threads& threads) {
    fillModels(threads, model_coefficients, inlier_indices);
  });
  if (!done) {
    model_coefficients.clear();
    inlier_indices.clear();
  }
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::segment(
    std::vector<ModelCoefficients>& model_coefficients,
    std::vector<PointIndices>& inlier_indices, Centroids& centroids,
    Covariances& covariances, PointCloudL& labels,
    std::vector<PointIndices>& label_indices)
{
  centroids.clear();
  covariances.clear();
  labels.clear();
  const bool done = run([&](const Threads& threads) {
    fillModels(threads, model_coefficients, inlier_indices);
    fillLabels(threads, labels, label_indices);
    for (const auto& region : result_.regions) {
      const Eigen::Vector3d centroid = pose_.rotation * region.centroid + pose_.origin;
      centroids.push_back(centroid.homogeneous().template cast<float>());
      const Eigen::Matrix3d covariance =
          pose_.rotation * region.covariance * pose_.rotation.transpose();
      covariances.push_back(covariance.template cast<float>());
    }
  });
  if (!done) {
    model_coefficients.clear();
    inlier_indices.clear();
    centroids.clear();
    covariances.clear();
    labels.clear();
    label_indices.clear();
  }
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::segment(PlanarRegions& regions)
{
  regions.clear();
  std::vector<PointIndices> boundaries;
  run([&](const Threads&) { fillRegions(regions, boundaries); });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::segmentAndRefine(
    PlanarRegions& regions, std::vector<ModelCoefficients>& model_coefficients,
    std::vector<PointIndices>& inlier_indices, PointCloudLPtr& labels,
    std::vector<PointIndices>& label_indices,
    std::vector<PointIndices>& boundary_indices)
{
  regions.clear();
  boundary_indices.clear();
  if (!labels)
    labels.reset(new PointCloudL);
  labels->clear();
  const bool done = run([&](const Threads& threads) {
    fillModels(threads, model_coefficients, inlier_indices);
    fillLabels(threads, *labels, label_indices);
    fillRegions(regions, boundary_indices);
  });
  if (!done) {
    regions.clear();
    model_coefficients.clear();
    inlier_indices.clear();
    labels->clear();
    label_indices.clear();
    boundary_indices.clear();
  }
}

template <typename PointT>
template <typename Fill>
bool MRFPlaneSegmentation<PointT>::run(const Fill& fill)
{
  wholes_.clear();
  bool done = false;
  if (initCompute()) { // else it has said why
    done = checkInput() && tryToSegment(fill);
    deinitCompute();
  }
  if (!done)
    result_ = {};
  return done;
}

template <typename PointT>
template <typename Fill>
bool MRFPlaneSegmentation<PointT>::tryToSegment(const Fill& fill)
{
  try {
    const auto start = std::chrono::steady_clock::now();
    const Threads threads(parameters_.number_of_threads);
    readPoints();
    const std::chrono::duration<double, std::milli> reading =
        std::chrono::steady_clock::now() - start;
    segmenter_.segment(points_, parameters_, result_);
    auto& stages = result_.report.stage_ms;
    stages.emplace(stages.begin(), "points", reading.count());
    if (separate_patches_)
      separatePatches();
    fill(threads);
    return true;
  }
  catch (const std::bad_alloc&) {
    PCL_ERROR("[pcl::%s::segment] Not enough memory for %zu points; segment the cloud "
              "in parts.\n",
              getClassName(), input_->size());
  }
  catch (const std::exception& error) {
    PCL_ERROR("[pcl::%s::segment] %s\n", getClassName(), error.what());
  }
  return false;
}

template <typename PointT>
bool MRFPlaneSegmentation<PointT>::checkInput() const
{
  const auto count = static_cast<std::uint64_t>(input_->width) * input_->height;
  if (input_->empty()) {
    PCL_ERROR("[pcl::%s::segment] The input cloud has no points.\n", getClassName());
    return false;
  }
  if (!input_->isOrganized() || count != input_->size()) {
    PCL_ERROR(
        "[pcl::%s::segment] The input cloud is not organized (width %u, height %u, "
        "%zu points); rows and columns as the sensor measured them are needed.\n",
        getClassName(), input_->width, input_->height, input_->size());
    return false;
  }
  if (count > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
    PCL_ERROR("[pcl::%s::segment] %zu points are more than 2^31 - 1; segment the cloud "
              "in parts.\n",
              getClassName(), input_->size());
    return false;
  }
  const auto outside = [&](index_t i) {
    return i < 0 || static_cast<std::size_t>(i) >= input_->size();
  };
  if (!fake_indices_ && std::any_of(indices_->begin(), indices_->end(), outside)) {
    PCL_ERROR("[pcl::%s::segment] The indices name a point outside the cloud of %zu "
              "points; set indices that belong to it.\n",
              getClassName(), input_->size());
    return false;
  }
  for (const std::string& complaint :
       {parameters_.validate(), outline_.validate(), crease_.validate()})
    if (!complaint.empty()) {
      PCL_ERROR("[pcl::%s::segment] %s.\n", getClassName(), complaint.c_str());
      return false;
    }
  return true;
}

template <typename PointT>
typename MRFPlaneSegmentation<PointT>::SensorPose
MRFPlaneSegmentation<PointT>::statedPose() const
{
  Eigen::Quaterniond orientation = input_->sensor_orientation_.template cast<double>();
  const double norm = orientation.norm();
  if (!(norm > 0.5 && norm < 2.0)) // an unset quaternion is no rotation
    orientation = Eigen::Quaterniond::Identity();
  SensorPose pose;
  pose.rotation = orientation.normalized().toRotationMatrix();
  pose.origin = input_->sensor_origin_.template head<3>().template cast<double>();
  if (!pose.origin.allFinite())
    pose.origin.setZero();
  return pose;
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::sightPoints(std::size_t most)
{
  const std::size_t step = std::max<std::size_t>(1, indices_->size() / most);
  sightings_.clear();
  for (std::size_t k = 0; k < indices_->size(); k += step) {
    const auto i = static_cast<std::size_t>((*indices_)[k]);
    const std::size_t row = i / input_->width;
    const std::size_t column = i % input_->width;
    const Eigen::Vector2d pixel(static_cast<double>(column), static_cast<double>(row));
    const PointT& p = (*input_)[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
      sightings_.push_back({Eigen::Vector3d(p.x, p.y, p.z), pixel});
  }
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::findPose()
{
  pose_ = statedPose();
  // Points spread over the image say where the sensor was: some hundreds where it was where
  // the cloud says, as nearly always, else a few thousand.
  constexpr std::size_t FEW = 500;
  constexpr std::size_t ENOUGH = 100; // of these, that were measured
  constexpr std::size_t MANY = 2000;
  const auto isPlausible = [&] {
    return pcl_mrf_planes::plausibleOrigin(sightings_, pose_.origin);
  };
  sightPoints(FEW);
  if (sightings_.size() >= ENOUGH && isPlausible())
    return;
  sightPoints(MANY);
  if (isPlausible())
    return;
  const bool found = pcl_mrf_planes::estimatePinholePose(sightings_, pose_);
  PCL_WARN(
      "[pcl::%s::segment] The cloud cannot have been seen from its sensor_origin_; "
      "%s.\n",
      getClassName(),
      found ? "found the sensor's pose from the cloud; set it to be exact"
            : "set sensor_origin_ and sensor_orientation_, the result is doubtful");
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::readPoints()
{
  findPose();
  const Eigen::Matrix3d to_sensor = pose_.rotation.transpose();
  const PointT* cloud = input_->points.data();
  const auto moved = [&](std::size_t i) -> Eigen::Vector3f {
    const Eigen::Vector3d p(cloud[i].x, cloud[i].y, cloud[i].z);
    return (to_sensor * (p - pose_.origin)).template cast<float>();
  };
  const auto width = static_cast<int>(input_->width);
  const auto height = static_cast<int>(input_->height);
  if (pose_.origin.isZero(0.0) &&
      to_sensor.isIdentity(0.0)) // the usual case: no motion
    copyPoints(width, height);
  else
    points_.fill(width, height, moved);
  if (!fake_indices_)
    limitToIndices();
  points_.resolveDepthMeasure(parameters_.depth_measure, parameters_.number_of_threads);
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::copyPoints(int width, int height)
{
  const PointT* cloud = input_->points.data();
  if constexpr (std::is_same_v<decltype(PointT::x), float> &&
                sizeof(PointT) % sizeof(float) == 0) {
    if (&cloud->y == &cloud->x + 1 && &cloud->z == &cloud->x + 2) {
      points_.load(width, height, &cloud->x, sizeof(PointT) / sizeof(float),
                   parameters_.number_of_threads);
      return; // as with all of PCL's point types
    }
  }
  points_.fill(width, height, [cloud](std::size_t i) {
    return Eigen::Vector3f(static_cast<float>(cloud[i].x),
                           static_cast<float>(cloud[i].y),
                           static_cast<float>(cloud[i].z));
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::limitToIndices()
{
  inside_.assign(points_.size(), 0);
  for (const auto i : *indices_)
    inside_[static_cast<std::size_t>(i)] = 1;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (inside_[i] == 0)
      points_.clear(i);
}

template <typename PointT>
Eigen::Vector4d
MRFPlaneSegmentation<PointT>::coefficients(const pcl_mrf_planes::Plane& plane) const
{
  Eigen::Vector4d result;
  result.head<3>() = pose_.rotation * plane.normal;
  result[3] = plane.d - result.head<3>().dot(pose_.origin);
  return result;
}

template <typename PointT>
template <typename Output>
void MRFPlaneSegmentation<PointT>::resizeOutput(std::vector<Output>& output,
                                                std::size_t size,
                                                std::vector<Output>& spare)
{
  constexpr std::size_t MOST = 64; // more than most clouds have planes
  for (; output.size() > size && spare.size() < MOST; output.pop_back())
    spare.push_back(std::move(output.back()));
  for (; output.size() < size && !spare.empty(); spare.pop_back())
    output.push_back(std::move(spare.back()));
  output.resize(size);
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::fillModels(
    const Threads& threads, std::vector<ModelCoefficients>& model_coefficients,
    std::vector<PointIndices>& inlier_indices)
{
  // What is there already is written over: a sequence needs no new memory.
  resizeOutput(model_coefficients, result_.regions.size(), spare_coefficients_);
  resizeOutput(inlier_indices, result_.regions.size(), spare_inliers_);
  threads.share(static_cast<int>(result_.regions.size()), [&](int number) {
    const auto k = static_cast<std::size_t>(number);
    const auto& region = result_.regions[k];
    ModelCoefficients& model = model_coefficients[k];
    model.header = input_->header;
    model.values.resize(4);
    Eigen::Vector4f::Map(model.values.data()) =
        coefficients(region.plane).template cast<float>();

    PointIndices& inliers = inlier_indices[k];
    inliers.header = input_->header;
    inliers.indices.assign(region.indices.begin(), region.indices.end());
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::fillLabels(const Threads& threads,
                                              PointCloudL& labels,
                                              std::vector<PointIndices>& label_indices)
{
  labels.header = input_->header;
  labels.resize(input_->size());
  labels.width = input_->width;
  labels.height = input_->height;
  labels.is_dense = true;
  labels.sensor_origin_ = input_->sensor_origin_;
  labels.sensor_orientation_ = input_->sensor_orientation_;
  threads.share(static_cast<int>(labels.height), [&](int row) {
    const std::size_t begin = static_cast<std::size_t>(row) * labels.width;
    for (std::size_t i = begin; i < begin + labels.width; ++i)
      labels[i].label = result_.labels[i];
  });

  resizeOutput(label_indices, result_.regions.size() + 1, spare_label_indices_);
  label_indices[0].header = {};
  label_indices[0].indices.clear();
  threads.share(static_cast<int>(result_.regions.size()), [&](int number) {
    const auto k = static_cast<std::size_t>(number);
    const auto& indices = result_.regions[k].indices;
    label_indices[k + 1].header = input_->header;
    label_indices[k + 1].indices.assign(indices.begin(), indices.end());
  });
}

template <typename PointT>
std::vector<PointIndices> MRFPlaneSegmentation<PointT>::contours() const
{
  const int width = points_.width;
  const int height = points_.height;
  const pcl_mrf_planes::ConnectedParts parts =
      pcl_mrf_planes::findConnectedParts(result_.labels, width, height);
  std::vector<int> largest(result_.regions.size(),
                           pcl_mrf_planes::ConnectedParts::NONE);
  for (std::size_t part = 0; part < parts.size.size(); ++part) {
    int& best = largest[static_cast<std::size_t>(parts.label[part] - 1)];
    if (best < 0 || parts.size[part] > parts.size[static_cast<std::size_t>(best)])
      best = static_cast<int>(part);
  }
  std::vector<PointIndices> result(result_.regions.size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    const std::vector<int> contour =
        pcl_mrf_planes::traceContour(parts, largest[k], width, height);
    result[k].header = input_->header;
    result[k].indices.assign(contour.begin(), contour.end());
  }
  return result;
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::fillRegions(
    PlanarRegions& regions, std::vector<PointIndices>& boundaries) const
{
  boundaries = contours();
  const std::vector<RegionOutline> shapes =
      simplify_contours_ ? outlines() : std::vector<RegionOutline>();
  for (std::size_t k = 0; k < result_.regions.size(); ++k) {
    const auto& region = result_.regions[k];
    const Eigen::Vector4d model = coefficients(region.plane);
    typename PointCloud::VectorType contour;
    for (const auto i : boundaries[k].indices) {
      PointT point = (*input_)[static_cast<std::size_t>(i)];
      if (project_points_) {
        const Eigen::Vector3d p(point.x, point.y, point.z);
        const Eigen::Vector3d q =
            p - (model.head<3>().dot(p) + model[3]) * model.head<3>();
        point.x = static_cast<float>(q.x());
        point.y = static_cast<float>(q.y());
        point.z = static_cast<float>(q.z());
      }
      contour.push_back(point);
    }
    if (simplify_contours_ && !shapes[k].patches.empty())
      contour = toContour(shapes[k].patches.front().outer);
    const Eigen::Vector3d centroid = pose_.rotation * region.centroid + pose_.origin;
    const Eigen::Matrix3d covariance =
        pose_.rotation * region.covariance * pose_.rotation.transpose();
    regions.emplace_back(centroid.template cast<float>(),
                         covariance.template cast<float>(),
                         static_cast<unsigned int>(region.indices.size()), contour,
                         model.template cast<float>());
  }
}

} // namespace pcl

#include <pcl_mrf_planes/impl/mrf_plane_analysis.hpp>

#define PCL_INSTANTIATE_MRFPlaneSegmentation(T)                                        \
  template class PCL_EXPORTS pcl::MRFPlaneSegmentation<T>;
