// SPDX-License-Identifier: BSD-3-Clause
//
// Robust planar patches: planar nodes of an octree by robust statistics grow over
// neighbouring points and merge. Written from the paper; see planar_patches.h. It takes
// clouds without order: nothing is made of the image.
#include "peer_list.h"
#include "planar_patches.h"

namespace pcl_mrf_planes::benchmarks {

namespace {

patches::Parameters parametersFrom(const Values& values)
{
  patches::Parameters parameters;
  parameters.neighbours = static_cast<int>(values.at("neighbours"));
  parameters.min_share = values.at("min_share");
  parameters.normal_variance = values.at("normal_variance");
  parameters.coplanarity = values.at("coplanarity");
  parameters.outlier_ratio = values.at("outlier_ratio");
  parameters.min_edge = values.at("min_edge");
  return parameters;
}

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  const patches::Parameters parameters = parametersFrom(values);
  const Stopwatch watch;
  const patches::PointSet set = patches::makePointSet(*cloud, parameters);
  std::vector<patches::Patch> found = patches::split(set, parameters);
  patches::growAndMerge(set, parameters, found);
  const auto label =
      values.at("boxes") != 0.0 ? patches::labelBoxes : patches::labelMembers;
  Labels labels = label(set, found, cloud->size());
  milliseconds = watch.milliseconds();
  return labels;
}

} // namespace

Peer makePlanarPatches()
{
  // Angles in degrees, the others as in planar_patches.h.
  const Values published = {
      {"neighbours", 30},  {"min_share", 0.001},    {"normal_variance", 60},
      {"coplanarity", 75}, {"outlier_ratio", 0.75}, {"min_edge", 0.01},
      {"boxes", 0}};
  Values boxes = published;
  boxes["boxes"] = 1;
  return {
      "planar_patches",
      "robust planar patches (Araujo and Oliveira, 2020), our implementation of the "
      "paper",
      {{"published", "defaults of Open3D's DetectPlanarPatches()", published},
       {"boxes", "the same, labels by the boxes that Open3D gives", boxes}},
      segment};
}

} // namespace pcl_mrf_planes::benchmarks
