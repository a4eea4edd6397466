// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "image_shape.h"

#include <pcl_mrf_planes/plane_segmentation.h>

#include <stdexcept>
#include <vector>

namespace pcl_mrf_planes::benchmarks {

/** \brief Section V of the paper, but merging less, so that the room at 640x480 gives as
 * many labels as asked for, up to 40. */
inline Parameters withLabels(int labels)
{
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.merge_threshold = 0.01;
  parameters.tile_width = parameters.tile_height = 20;
  parameters.noise_multiplier = 3.0;
  parameters.max_planes = labels;
  return parameters;
}

/** \brief The same for clouds of depth cameras, of which some give 40 labels: tiles may
 * deviate far from their planes. */
inline Parameters withLabelsOnClouds(int labels)
{
  Parameters parameters = Parameters::fromProfile(Profile::PAPER);
  parameters.merge_threshold = 0.1;
  parameters.noise_multiplier = 14.0;
  parameters.max_planes = labels;
  return parameters;
}

/** \brief The label planes that the room at 640x480 gives.
 * \throws std::runtime_error when they are not as many as asked for */
inline std::vector<Plane> labelPlanes(const Parameters& parameters)
{
  const PlaneClusters clusters =
      clusterTilePlanes(detectTilePlanes(roomPoints(VGA), parameters), parameters);
  if (static_cast<int>(clusters.planes.size()) != parameters.max_planes)
    throw std::runtime_error("the scene gives fewer labels than the benchmark needs");
  std::vector<Plane> planes;
  for (const PlaneModel& model : clusters.planes)
    planes.push_back(model.plane);
  return planes;
}

} // namespace pcl_mrf_planes::benchmarks
