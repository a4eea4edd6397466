// SPDX-License-Identifier: BSD-3-Clause
//
// Parameters at random, some of them out of range: what validate() lets through must run.
//
// Bytes: profile, then pairs of a parameter's number and its value.
#include "fuzz_class.h"

#include <cstdint>

namespace pcl_mrf_planes::fuzz {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// A floor, a wall with a step, a hole and a bump, 48x40 points.
Cloud::Ptr smallScene()
{
  Cloud::Ptr cloud(new Cloud(48, 40));
  for (int v = 0; v < 40; ++v)
    for (int u = 0; u < 48; ++u) {
      const float x = 0.02f * static_cast<float>(u - 24);
      const float y = 0.02f * static_cast<float>(v - 20);
      float z = v < 20 ? 2.0f : 2.0f - 2.0f * y;
      if (u > 30 && v < 20)
        z = 1.5f;
      if (u < 12 && v > 28)
        z += 3.0f * (x + 0.4f) * (x + 0.4f) + 0.3f * y * y;
      z += 0.001f * static_cast<float>((u * 7 + v * 13) % 5 - 2); // as if of noise
      const bool hole = u > 14 && u < 20 && v > 5 && v < 12;
      cloud->at(u, v) = {x * z, y * z, hole ? std::nanf("") : z};
    }
  cloud->is_dense = false;
  return cloud;
}

/// Small numbers mostly: a size or count of 100000 is valid and only slow.
int hostileInt(Bytes& bytes)
{
  static constexpr std::array<int, 8> KNOWN = {
      0, 1, -1, 2, 4096, -4096, 2147483647, -2147483647 - 1};
  const std::uint8_t choice = bytes.byte();
  return choice < 64 ? KNOWN[choice % KNOWN.size()] : bytes.within(0, 40);
}

void setReal(Parameters& p, int which, double value)
{
  AdaptiveParameters& a = p.adaptive;
  double* const reals[] = {&p.noise_multiplier,
                           &p.min_valid_share,
                           &p.beta,
                           &p.merge_threshold,
                           &p.lambda,
                           &p.tau,
                           &p.gamma,
                           &p.convergence_tolerance,
                           &p.min_area,
                           &p.noise.a,
                           &p.noise.b,
                           &p.noise.c,
                           &a.tile_tolerance,
                           &a.min_fill,
                           &a.noise_percentile,
                           &a.growth_percentile,
                           &a.max_growth,
                           &a.long_range,
                           &a.flatness,
                           &a.max_flatness,
                           &a.flatness_noise,
                           &a.quiet_flatness,
                           &a.min_sigma,
                           &a.local_percentile,
                           &a.max_local,
                           &a.merge_tolerance,
                           &a.region_tolerance,
                           &a.accept_tolerance,
                           &a.min_evidence,
                           &a.join_tolerance,
                           &a.join_gap,
                           &a.join_seen,
                           &a.fan_angle,
                           &a.fan_share,
                           &a.fan_border,
                           &a.fan_gap,
                           &a.fan_ring,
                           &a.bend_angle,
                           &a.none_cost,
                           &a.label_change,
                           &a.step_sigmas,
                           &a.min_weight};
  *reals[static_cast<std::size_t>(which) % std::size(reals)] = value;
}

void setInt(Parameters& p, int which, int value)
{
  AdaptiveParameters& a = p.adaptive;
  int* const ints[] = {&p.tile_width,  &p.tile_height,    &p.max_planes,
                       &p.min_inliers, &a.sampling,       &a.least_samples,
                       &a.levels,      &a.smallest_level, &a.local_reach,
                       &a.min_points,  &a.fan_parts,      &a.support_reach,
                       &a.rounds};
  *ints[static_cast<std::size_t>(which) % std::size(ints)] = value;
}

void setChoice(Parameters& p, int which, std::uint8_t value)
{
  switch (which % 9) {
  case 0:
    p.fit = static_cast<PlaneFit>(value % 2);
    break;
  case 1:
    p.smoothness = static_cast<Smoothness>(value % 4);
    break;
  case 2:
    p.depth_measure = static_cast<DepthMeasure>(value % 3);
    break;
  case 3:
    p.iterations = value % 20;
    break;
  case 4:
    p.compute_energy = value % 2 != 0;
    break;
  case 5:
    p.adaptive.passes = value % 5;
    break;
  case 6:
    p.adaptive.estimate_noise = value % 2 != 0;
    break;
  case 7:
    p.adaptive.join_coplanar = value % 2 != 0;
    break;
  default:
    p.adaptive.join_over_occluders = value % 2 != 0;
    break;
  }
}

void run(Bytes bytes)
{
  static const Cloud::Ptr cloud = smallScene();
  Parameters p = Parameters::fromProfile(static_cast<Profile>(bytes.byte() % 3));
  while (bytes.left() > 2) {
    const int kind = bytes.byte();
    const int which = bytes.byte();
    if (kind % 3 == 0)
      setReal(p, which, bytes.hostile());
    else if (kind % 3 == 1)
      setInt(p, which, hostileInt(bytes));
    else
      setChoice(p, which, bytes.byte());
  }
  Segmentation segmentation;
  segmentation.setParameters(p);
  const std::size_t planes = segmentSoundly(segmentation, cloud);
  require(planes == 0 || p.validate().empty(), "planes by parameters out of range");
}

} // namespace
} // namespace pcl_mrf_planes::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pcl_mrf_planes::fuzz::run({data, size});
  return 0;
}
