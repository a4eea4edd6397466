// SPDX-License-Identifier: BSD-3-Clause
//
// CAPE: planar cells of the image grow from the commonest directions, segments of one
// plane merge, and their borders are found point by point. Written from the paper; see
// cape.h.
#include "cape.h"
#include "peer_list.h"

namespace pcl_mrf_planes::benchmarks {

namespace {

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  cape::Parameters parameters;
  parameters.cell_side = static_cast<int>(values.at("cell_side"));
  parameters.merge_distance = values.at("merge_distance");
  parameters.depth_step = values.at("depth_step");
  const Stopwatch watch;
  const BlockGrid grid = {static_cast<int>(cloud->width),
                          static_cast<int>(cloud->height), parameters.cell_side};
  const std::vector<cape::Cell> cells = cape::fitCells(*cloud, grid, parameters);
  const std::vector<cape::Segment> segments = cape::mergeSegments(
      cape::growSegments(cells, grid, parameters), grid, parameters);
  Labels labels = cape::refine(*cloud, segments, grid);
  milliseconds = watch.milliseconds();
  return labels;
}

} // namespace

Peer makeCape()
{
  return {"cape",
          "CAPE (Proenca and Gao, IROS 2018), planes, our implementation of the paper",
          {{"published",
            "values that the authors publish",
            {{"cell_side", 20}, {"merge_distance", 0.00707}, {"depth_step", 0.1}}},
           {"fine",
            "cells of 10 points",
            {{"cell_side", 10}, {"merge_distance", 0.00707}, {"depth_step", 0.1}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
