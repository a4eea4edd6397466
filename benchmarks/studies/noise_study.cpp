// SPDX-License-Identifier: BSD-3-Clause
#include "parallel.h"
#include "peer_list.h"
#include "studies.h"

#include "scenes/random.h"
#include "scenes/render.h"
#include "scenes/scene_library.h"

#include <cmath>

namespace pcl_mrf_planes::benchmarks {

namespace {

constexpr int ROOMS = 6;
constexpr std::size_t SMALLEST_PLANE = 150; // points; smaller ones are not scored
const std::vector<const char*> KINECT_SCALES = {"0", "0.5", "1", "2", "3", "4", "5"};
const std::vector<const char*> RAY_MILLIMETRES = {"0", "2", "5", "10", "15", "20"};
constexpr const char* SCAN_SET = "synpeb";
constexpr std::size_t SCAN_SIDE = 500; // the small scans are too small for such noise

evaluation::LabelImage truthOf(const scenes::SceneFrame& frame)
{
  evaluation::LabelImage truth = {frame.width, frame.height, frame.labels};
  const std::vector<std::size_t> counts = frame.labelCounts();
  for (std::uint16_t& label : truth.labels)
    if (label != 0 && counts[label] < SMALLEST_PLANE)
      label = evaluation::NOT_SCORED;
  return truth;
}

LabelledCloud takeRoom(std::uint64_t seed, const std::string& scale)
{
  const scenes::View view = scenes::makeRoom(seed);
  const scenes::SceneFrame frame = scenes::render(
      view.scene, view.camera, scenes::SensorNoise::kinect(std::stod(scale)), seed);
  const Cloud::Ptr cloud(new Cloud(static_cast<std::uint32_t>(frame.width),
                                   static_cast<std::uint32_t>(frame.height)));
  cloud->is_dense = false;
  for (std::size_t i = 0; i < frame.size(); ++i)
    (*cloud)[i] = pcl::PointXYZ(frame.x[i], frame.y[i], frame.z[i]);
  return {"kinect " + scale, "room " + std::to_string(seed), cloud, truthOf(frame)};
}

LabelledCloud withRayNoise(const LabelledCloud& scan, const std::string& millimetres)
{
  LabelledCloud noisy = scan;
  noisy.set = SCAN_SET + (' ' + millimetres);
  const Cloud::Ptr cloud(new Cloud(*scan.cloud));
  scenes::Random random(1);
  for (pcl::PointXYZ& point : *cloud) {
    const float range = point.getVector3fMap().norm();
    const double error = 1e-3 * std::stod(millimetres) * random.normal();
    if (range > 0.0f) // not where nothing was measured
      point.getVector3fMap() *= 1.0f + static_cast<float>(error) / range;
  }
  noisy.cloud = cloud;
  return noisy;
}

/// Both profiles, and the other methods that take the whole cloud at once, as tuned.
std::vector<Variant> methods()
{
  std::vector<Variant> variants;
  for (const Peer& peer : allPeers())
    for (const Setting& setting : peer.settings) {
      const bool is_ours = peer.name == "mrf_planes";
      const bool is_grown =
          peer.name == "pcl_multi_plane" || peer.name == "opencv_rgbd_plane";
      if (is_ours || (is_grown && setting.name == "tuned"))
        variants.push_back(
            {peer.name + ' ' + setting.name,
             [peer, setting](const Cloud::ConstPtr& cloud, double& milliseconds) {
               return peer.segment(cloud, setting.values, milliseconds);
             }});
    }
  return variants;
}

} // namespace

Study noiseStudy(const std::vector<LabelledCloud>& clouds, unsigned int threads)
{
  Study study = {"noise", methods(), {}};
  study.clouds.resize(KINECT_SCALES.size() * ROOMS);
  doAll(study.clouds.size(), threads, [&](std::size_t i) {
    study.clouds[i] = takeRoom(i % ROOMS + 1, KINECT_SCALES[i / ROOMS]);
  });
  for (const LabelledCloud& cloud : clouds)
    if (cloud.set == SCAN_SET && cloud.cloud->width == SCAN_SIDE)
      for (const char* millimetres : RAY_MILLIMETRES)
        study.clouds.push_back(withRayNoise(cloud, millimetres));
  return study;
}

} // namespace pcl_mrf_planes::benchmarks
