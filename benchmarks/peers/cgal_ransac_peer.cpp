// SPDX-License-Identifier: BSD-3-Clause
//
// CGAL's Efficient RANSAC (Schnabel et al., CGF 2007), planes only, on the normals of
// PCL's integral images. CGAL's part is under the GPL: a program with this file in it
// may be passed on under the GPL only. Nothing here is installed.
#include "integral_normals.h"
#include "peer_list.h"

#include <CGAL/Random.h>
#include <CGAL/Shape_detection/Efficient_RANSAC.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <cmath>
#include <tuple>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr unsigned int SEED = 1;

using Kernel = CGAL::Simple_cartesian<double>;
using Sample = std::tuple<Kernel::Point_3, Kernel::Vector_3, std::size_t>;
using Samples = std::vector<Sample>;
using PointMap = CGAL::Nth_of_tuple_property_map<0, Sample>;
using NormalMap = CGAL::Nth_of_tuple_property_map<1, Sample>;
using Traits = CGAL::Shape_detection::Efficient_RANSAC_traits<Kernel, Samples, PointMap,
                                                              NormalMap>;
using Ransac = CGAL::Shape_detection::Efficient_RANSAC<Traits>;

/// Points with a normal, each with its place in the cloud.
Samples makeSamples(const Cloud& cloud, const pcl::PointCloud<pcl::Normal>& normals)
{
  Samples samples;
  samples.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const pcl::Normal& n = normals[i];
    if (std::isfinite(n.normal_x) && std::isfinite(cloud[i].z))
      samples.emplace_back(Kernel::Point_3(cloud[i].x, cloud[i].y, cloud[i].z),
                           Kernel::Vector_3(n.normal_x, n.normal_y, n.normal_z), i);
  }
  return samples;
}

/// Zero leaves a parameter to CGAL, which takes a share of the cloud's size.
Ransac::Parameters makeParameters(const Values& values)
{
  Ransac::Parameters parameters;
  parameters.probability = values.at("probability");
  parameters.normal_threshold = std::cos(values.at("angle") * M_PI / 180.0);
  if (values.at("min_points") > 0.0)
    parameters.min_points = static_cast<std::size_t>(values.at("min_points"));
  if (values.at("epsilon") > 0.0)
    parameters.epsilon = values.at("epsilon");
  if (values.at("cluster_epsilon") > 0.0)
    parameters.cluster_epsilon = values.at("cluster_epsilon");
  return parameters;
}

Labels segment(const Cloud::ConstPtr& cloud, const Values& values, double& milliseconds)
{
  Labels labels(cloud->size(), 0);
  CGAL::get_default_random() = CGAL::Random(SEED);
  const Stopwatch watch;
  Samples samples = makeSamples(*cloud, *integralNormals(cloud, values));
  if (samples.empty())
    return labels;
  Ransac ransac;
  ransac.set_input(samples);
  ransac.add_shape_factory<CGAL::Shape_detection::Plane<Traits>>();
  ransac.detect(makeParameters(values));
  std::uint16_t label = 0;
  for (const auto& plane : ransac.planes()) {
    ++label;
    for (const std::size_t i : plane->indices_of_assigned_points())
      labels[std::get<2>(samples[i])] = label;
  }
  milliseconds = watch.milliseconds();
  return labels;
}

} // namespace

Peer makeCgalRansac()
{
  // Angle in degrees, lengths in metres, 0: CGAL's default for the cloud.
  return {"cgal_efficient_ransac",
          "CGAL::Shape_detection::Efficient_RANSAC, planes",
          {{"published",
            "defaults of the class: 1 % of the points, 1 % of the box's diagonal, "
            "cosine 0.9; normals as in PCL's openni_organized_multi_plane_segmentation",
            {{"probability", 0.01},
             {"min_points", 0},
             {"epsilon", 0},
             {"cluster_epsilon", 0},
             {"angle", 25.842},
             {"smoothing", 20},
             {"depth_change", 0.03}}},
           {"tuned",
            "best of tune_peers.py",
            {{"probability", 0.01},
             {"min_points", 1000},
             {"epsilon", 0.005},
             {"cluster_epsilon", 0.03},
             {"angle", 25},
             {"smoothing", 10},
             {"depth_change", 0.02}}}},
          segment};
}

} // namespace pcl_mrf_planes::benchmarks
