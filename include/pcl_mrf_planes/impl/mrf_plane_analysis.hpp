// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_mrf_planes/label_confidence.h>
#include <pcl_mrf_planes/mrf_plane_segmentation.h>
#include <pcl_mrf_planes/region_parts.h>

#include <pcl/console/print.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace pcl {

template <typename PointT>
template <typename Work>
void MRFPlaneSegmentation<PointT>::analyse(const char* name, const Work& work) const
{
  if (result_.labels.empty() || !input_ || input_->size() != result_.labels.size()) {
    PCL_ERROR(
        "[pcl::%s::%s] There is no result for this cloud; call segment() first.\n",
        getClassName(), name);
    return;
  }
  try {
    work();
  }
  catch (const std::bad_alloc&) {
    PCL_ERROR("[pcl::%s::%s] Not enough memory for %zu points; segment the cloud in "
              "parts.\n",
              getClassName(), name, input_->size());
  }
  catch (const std::exception& error) {
    PCL_ERROR("[pcl::%s::%s] %s\n", getClassName(), name, error.what());
  }
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::separatePatches()
{
  wholes_ = std::move(result_.regions);
  result_.regions = pcl_mrf_planes::separateParts(
      points_, wholes_, std::max(1, parameters_.min_inliers), parameters_.min_area);
  result_.labels = pcl_mrf_planes::regionLabels(points_, result_.regions);
  result_.report.count(points_, result_.regions);
}

template <typename PointT>
const std::vector<pcl_mrf_planes::PlaneRegion>&
MRFPlaneSegmentation<PointT>::wholeRegions() const
{
  return wholes_.empty() ? result_.regions : wholes_;
}

template <typename PointT>
std::size_t MRFPlaneSegmentation<PointT>::wholeRegion(std::size_t region) const
{
  return wholes_.empty() ? region
                         : static_cast<std::size_t>(result_.regions[region].label);
}

template <typename PointT>
std::vector<pcl_mrf_planes::RegionOutline>
MRFPlaneSegmentation<PointT>::outlines() const
{
  const std::string complaint = outline_.validate();
  if (!complaint.empty())
    throw std::runtime_error(complaint + ".");
  std::vector<RegionOutline> result;
  for (const RegionOutline& outline :
       pcl_mrf_planes::outlineRegions(points_, result_.regions, outline_))
    result.push_back(pcl_mrf_planes::inCloudFrame(outline, pose_));
  return result;
}

template <typename PointT>
typename MRFPlaneSegmentation<PointT>::PointCloud::VectorType
MRFPlaneSegmentation<PointT>::toContour(const pcl_mrf_planes::PlaneRing& ring) const
{
  typename PointCloud::VectorType contour;
  for (const Eigen::Vector3d& corner : ring) {
    PointT point;
    point.x = static_cast<float>(corner.x());
    point.y = static_cast<float>(corner.y());
    point.z = static_cast<float>(corner.z());
    contour.push_back(point);
  }
  return contour;
}

template <typename PointT>
PlanarPolygon<PointT>
MRFPlaneSegmentation<PointT>::toPolygon(const pcl_mrf_planes::PlaneRing& ring,
                                        std::size_t region) const
{
  typename PointCloud::VectorType contour = toContour(ring);
  Eigen::Vector4f model =
      coefficients(result_.regions[region].plane).template cast<float>();
  return PlanarPolygon<PointT>(contour, model);
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeUncertainties(
    std::vector<PlaneUncertainty>& uncertainties) const
{
  uncertainties.clear();
  analyse("computeUncertainties", [&] {
    const std::vector<PlaneUncertainty> of_wholes = pcl_mrf_planes::planeUncertainties(
        points_, wholeRegions(), pcl_mrf_planes::UncertaintyNoise::of(parameters_));
    for (std::size_t k = 0; k < result_.regions.size(); ++k)
      uncertainties.push_back(
          pcl_mrf_planes::inCloudFrame(of_wholes[wholeRegion(k)], pose_));
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeOutlines(
    std::vector<RegionOutline>& region_outlines) const
{
  region_outlines.clear();
  analyse("computeOutlines", [&] { region_outlines = outlines(); });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computePolygons(
    PlanarPolygons& polygons, std::vector<std::size_t>& region_of_polygon) const
{
  polygons.clear();
  region_of_polygon.clear();
  analyse("computePolygons", [&] {
    const std::vector<RegionOutline> shapes = outlines();
    for (std::size_t k = 0; k < shapes.size(); ++k)
      for (const pcl_mrf_planes::PlanePolygon& patch : shapes[k].patches) {
        polygons.push_back(toPolygon(patch.outer, k));
        region_of_polygon.push_back(k);
      }
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeHulls(PlanarPolygons& hulls) const
{
  hulls.clear();
  analyse("computeHulls", [&] {
    const std::vector<RegionOutline> shapes = outlines();
    for (std::size_t k = 0; k < shapes.size(); ++k)
      hulls.push_back(toPolygon(shapes[k].hull, k));
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeCreases(
    std::vector<PlaneCrease>& creases) const
{
  creases.clear();
  analyse("computeCreases", [&] {
    const std::string complaint = crease_.validate();
    if (!complaint.empty())
      throw std::runtime_error(complaint + ".");
    for (const PlaneCrease& crease :
         pcl_mrf_planes::findCreases(points_, result_.regions, crease_))
      creases.push_back(pcl_mrf_planes::inCloudFrame(crease, pose_));
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeConfidence(
    std::vector<float>& confidence) const
{
  confidence.clear();
  analyse("computeConfidence", [&] {
    if (wholes_.empty()) {
      confidence = pcl_mrf_planes::labelConfidence(points_, result_, parameters_);
      return;
    }
    pcl_mrf_planes::PlaneSegmentation of_wholes;
    of_wholes.regions = wholes_;
    of_wholes.labels = pcl_mrf_planes::regionLabels(points_, wholes_);
    of_wholes.clusters = result_.clusters;
    of_wholes.block_noise = result_.block_noise;
    confidence = pcl_mrf_planes::labelConfidence(points_, of_wholes, parameters_);
  });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::projectPoints(const pcl_mrf_planes::Plane& plane,
                                                 const std::vector<int>& indices,
                                                 ProjectionWay way,
                                                 PointCloud& cloud) const
{
  if (indices.empty())
    return;
  if constexpr (std::is_same_v<decltype(PointT::x), float> &&
                sizeof(PointT) % sizeof(float) == 0) {
    PointT& first = cloud.points.front();
    if (&first.y == &first.x + 1 && &first.z == &first.x + 2) {
      pcl_mrf_planes::projectPoints(plane, pose_.origin, way, indices,
                                    sizeof(PointT) / sizeof(float), &first.x);
      return; // as with all of PCL's point types
    }
  }
  for (const int index : indices) {
    PointT& point = cloud[static_cast<std::size_t>(index)];
    const Eigen::Vector3d p(point.x, point.y, point.z);
    const Eigen::Vector3d q =
        pcl_mrf_planes::projectPoint(p - pose_.origin, plane, way) + pose_.origin;
    using Number = decltype(PointT::x);
    point.x = static_cast<Number>(q.x());
    point.y = static_cast<Number>(q.y());
    point.z = static_cast<Number>(q.z());
  }
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::computeStages(
    pcl_mrf_planes::SegmentationStages& stages) const
{
  stages = {};
  analyse("computeStages",
          [&] { stages = pcl_mrf_planes::recordStages(points_, parameters_); });
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::projectOntoPlanes(PointCloud& output,
                                                     ProjectionWay way) const
{
  bool done = false;
  analyse("projectOntoPlanes", [&] {
    output = *input_; // memory that the output has is used again
    for (const pcl_mrf_planes::PlaneRegion& region : result_.regions) {
      // Axes of the cloud, origin at the sensor.
      pcl_mrf_planes::Plane plane = region.plane;
      plane.normal = pose_.rotation * region.plane.normal;
      projectPoints(plane, region.indices, way, output);
    }
    done = true;
  });
  if (!done)
    output = PointCloud();
}

template <typename PointT>
void MRFPlaneSegmentation<PointT>::extractIndices(PointIndices& on_planes,
                                                  PointIndices& rest) const
{
  on_planes = {};
  rest = {};
  analyse("extractIndices", [&] {
    on_planes.header = rest.header = input_->header;
    for (std::size_t i = 0; i < result_.labels.size(); ++i)
      if (result_.labels[i] != 0)
        on_planes.indices.push_back(static_cast<index_t>(i));
    const std::vector<int> left =
        pcl_mrf_planes::pointsOfNoPlane(points_, result_.labels);
    rest.indices.assign(left.begin(), left.end());
  });
}

} // namespace pcl
