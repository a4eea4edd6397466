// SPDX-License-Identifier: BSD-3-Clause
//
// CAPE: planar cells of the image grow from the commonest directions, segments of one
// plane merge, and their borders are found point by point. Written from the paper; see
// cape.h.
#include "cape.h"
#include "peer_list.h"

namespace pcl_mrf_planes::benchmarks {

namespace {

cape::Parameters parametersFrom(const Values& values)
{
  cape::Parameters parameters;
  parameters.cell_side = static_cast<int>(values.at("cell_side"));
  parameters.depth_step = values.at("depth_step");
  parameters.angle = values.at("angle");
  parameters.most_distance = values.at("most_distance");
  parameters.merge_distance = values.at("merge_distance");
  parameters.min_seeds = static_cast<int>(values.at("min_seeds"));
  parameters.min_cells = static_cast<int>(values.at("min_cells"));
  parameters.min_flatness = values.at("min_flatness");
  return parameters;
}

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  const cape::Parameters parameters = parametersFrom(values);
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
  // Sides in points, lengths in metres, the angle in degrees; see cape.h.
  const Values published = {
      {"cell_side", 20},       {"depth_step", 0.1},         {"angle", 15},
      {"most_distance", 0.05}, {"merge_distance", 0.00707}, {"min_seeds", 5},
      {"min_cells", 4},        {"min_flatness", 100}};
  Values fine = published;
  fine["cell_side"] = 10;
  return {"cape",
          "CAPE (Proenca and Gao, IROS 2018), planes, our implementation of the paper",
          {{"published", "values that the authors publish", published},
           {"fine", "the same with cells of 10 points", fine}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
