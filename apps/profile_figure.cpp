// SPDX-License-Identifier: BSD-3-Clause
#include "profile_figure.h"

#include "colour_track.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <stdexcept>

namespace pcl_mrf_planes::apps {

namespace {

/// Labels of a profile, numbered so that planes that are known keep their colours.
pcl::PointCloud<pcl::Label>
colourNumbers(const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& cloud,
              const Parameters& parameters, ColourTrack& track)
{
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setParameters(parameters);
  segmentation.setInputCloud(cloud);
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(models, inliers);
  const PlaneSegmentation& result = segmentation.getResult();
  if (result.labels.size() != cloud->size())
    throw std::runtime_error("cannot be segmented in the memory there is; cut it into "
                             "parts");
  std::vector<Plane> planes;
  for (const PlaneRegion& region : result.regions)
    planes.push_back(region.plane);
  const std::vector<std::uint32_t> numbers = track.update(planes, result.labels);
  pcl::PointCloud<pcl::Label> labels(cloud->width, cloud->height);
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i].label = result.labels[i] == 0 ? 0 : numbers[result.labels[i] - 1U];
  return labels;
}

} // namespace

Picture profileFigure(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                      const std::vector<Colour>& colours, const Parameters& parameters)
{
  const pcl::PointCloud<pcl::PointXYZ>::ConstPtr shared(
      new pcl::PointCloud<pcl::PointXYZ>(cloud));
  const OrganizedPoints points = inSensorFrame(cloud, parameters.depth_measure);
  ColourTrack track;
  const auto row = [&](Profile profile) {
    Parameters of_profile = Parameters::fromProfile(profile);
    of_profile.depth_measure = parameters.depth_measure;
    of_profile.number_of_threads = parameters.number_of_threads;
    return overlay(points, colours, colourNumbers(shared, of_profile, track));
  };
  const Picture paper = row(Profile::PAPER);
  return stack(paper, row(Profile::DEFAULT));
}

} // namespace pcl_mrf_planes::apps
