// SPDX-License-Identifier: BSD-3-Clause
#include "segmented_view.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

namespace pcl_mrf_planes::viewer {

namespace {

using Segmentation = pcl::MRFPlaneSegmentation<pcl::PointXYZ>;

std::vector<ViewPlane> planesOf(const Segmentation& segmentation,
                                const std::vector<pcl::ModelCoefficients>& models,
                                const Segmentation::Centroids& centroids)
{
  std::vector<ViewPlane> planes;
  const auto& regions = segmentation.getResult().regions;
  for (std::size_t k = 0; k < models.size(); ++k) {
    const Eigen::Vector4d c = Eigen::Vector4f(models[k].values.data()).cast<double>();
    planes.push_back({c.head<3>(), c[3], centroids[k].head<3>().cast<double>(),
                      regions[k].indices.size(), regions[k].area, regions[k].rms});
  }
  return planes;
}

std::vector<PlaneDeviations> deviationsOf(const Segmentation& segmentation)
{
  std::vector<PlaneUncertainty> uncertainties;
  segmentation.computeUncertainties(uncertainties);
  std::vector<PlaneDeviations> deviations;
  for (const PlaneUncertainty& uncertainty : uncertainties) {
    if (!uncertainty.valid) {
      constexpr double UNKNOWN = std::numeric_limits<double>::infinity();
      deviations.push_back({UNKNOWN, UNKNOWN, Eigen::Matrix4d::Constant(UNKNOWN)});
      continue;
    }
    const Eigen::Matrix2d turns = uncertainty.minimal.topLeftCorner<2, 2>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(turns);
    deviations.push_back({std::sqrt(std::max(0.0, solver.eigenvalues()[1])),
                          std::sqrt(std::max(0.0, uncertainty.minimal(2, 2))),
                          uncertainty.covariance});
  }
  return deviations;
}

/// Two centimetres are seen, and no more corners than they need.
OutlineParameters outlineParameters()
{
  OutlineParameters parameters;
  parameters.tolerance = 0.02;
  parameters.min_points = 40;
  parameters.min_hole_area = 0.002;
  return parameters;
}

/// Works something out when it is asked for the first time: every picture asks again.
template <typename Work>
auto once(const Work& work)
{
  const auto result = std::make_shared<std::optional<decltype(work())>>();
  return [work, result] {
    if (!*result)
      *result = work();
    return **result;
  };
}

} // namespace

double SegmentedView::totalMs() const
{
  double sum = 0.0;
  for (const auto& stage : stage_ms)
    sum += stage.second;
  return sum;
}

SegmentedView segmentView(const ViewFrame& frame, const Parameters& parameters,
                          const std::string& method)
{
  const auto segmentation = std::make_shared<Segmentation>();
  segmentation->setParameters(parameters);
  segmentation->setOutlineParameters(outlineParameters());
  segmentation->setInputCloud(frame.cloud);
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers, label_indices;
  Segmentation::Centroids centroids;
  Segmentation::Covariances covariances;
  pcl::PointCloud<pcl::Label> labels;
  segmentation->segment(models, inliers, centroids, covariances, labels, label_indices);
  if (labels.size() != frame.cloud->size())
    throw std::runtime_error("'" + frame.name +
                             "' cannot be segmented with these parameters");
  SegmentedView view;
  view.method = method;
  view.labels = segmentation->getResult().labels;
  view.planes = planesOf(*segmentation, models, centroids);
  view.stage_ms = segmentation->getReport().stage_ms;
  view.confidence = once([segmentation] {
    std::vector<float> confidence;
    segmentation->computeConfidence(confidence);
    return confidence;
  });
  view.creases = once([segmentation] {
    std::vector<PlaneCrease> creases;
    segmentation->computeCreases(creases);
    return creases;
  });
  view.outlines = once([segmentation] {
    std::vector<RegionOutline> outlines;
    segmentation->computeOutlines(outlines);
    return outlines;
  });
  view.projected = once([segmentation] {
    const pcl::PointCloud<pcl::PointXYZ>::Ptr moved(new pcl::PointCloud<pcl::PointXYZ>);
    segmentation->projectOntoPlanes(*moved, ProjectionWay::RAY);
    return pcl::PointCloud<pcl::PointXYZ>::ConstPtr(moved);
  });
  view.deviations = once([segmentation] { return deviationsOf(*segmentation); });
  return view;
}

double distanceToPlane(const ViewFrame& frame, const SegmentedView& view,
                       std::size_t index)
{
  const std::uint16_t label = view.labels[index];
  if (label == 0 || label > view.planes.size())
    return std::numeric_limits<double>::quiet_NaN();
  const ViewPlane& plane = view.planes[label - 1u];
  const pcl::PointXYZ& p = (*frame.cloud)[index];
  return plane.normal.dot(Eigen::Vector3d(p.x, p.y, p.z)) + plane.d;
}

double deviationAt(const Eigen::Vector3d& point, const PlaneDeviations& deviations)
{
  // Of n p + d, to first order.
  const Eigen::Vector4d place = point.homogeneous();
  return std::sqrt(std::max(0.0, place.dot(deviations.covariance * place)));
}

} // namespace pcl_mrf_planes::viewer
