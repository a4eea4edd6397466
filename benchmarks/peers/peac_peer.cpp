// SPDX-License-Identifier: BSD-3-Clause
//
// PEAC: blocks of the image merge into planes in the order of their errors, and planes
// grow to their borders point by point. Written from the paper; see peac.h.
#include "peac.h"
#include "peer_list.h"

namespace pcl_mrf_planes::benchmarks {

namespace {

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  peac::Parameters parameters;
  parameters.block_side = static_cast<int>(values.at("block_side"));
  parameters.loose_start = values.at("loose_start") != 0.0;
  parameters.min_points = static_cast<int>(values.at("min_points"));
  const Stopwatch watch;
  peac::Graph graph = peac::makeGraph(*cloud, parameters);
  const peac::Clusters clusters = peac::cluster(graph, parameters);
  Labels labels = peac::refine(*cloud, graph, clusters, parameters);
  milliseconds = watch.milliseconds();
  return labels;
}

} // namespace

Peer makePeac()
{
  return {"peac",
          "PEAC (Feng et al., ICRA 2014), our implementation of the paper",
          {{"published",
            "values that the authors publish: no point of a block may be missing",
            {{"block_side", 10}, {"loose_start", 0}, {"min_points", 3000}}},
           {"loose",
            "blocks may lack up to half of their points, planes of 1000 points",
            {{"block_side", 10}, {"loose_start", 1}, {"min_points", 1000}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
