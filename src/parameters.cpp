// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/parameters.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace pcl_mrf_planes {

namespace {

constexpr double LARGEST = 1e6; // metres or 1/m: beyond it a value is a mistake

/// Appends the first complaint only: one clear sentence helps more than ten.
class RangeCheck {
public:
  void check(const char* name, double value, double low, double high)
  {
    // Written so that NaN fails.
    if (!message_.empty() || (value >= low && value <= high))
      return;
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << name << " is " << value << "; choose a value from " << low << " to "
         << high;
    message_ = text.str();
  }
  const std::string& message() const { return message_; }

private:
  std::string message_;
};

void checkAdaptive(const AdaptiveParameters& p, RangeCheck& range)
{
  constexpr double SMALLEST = 1e-6;
  range.check("sampling", p.sampling, 1, 8);
  range.check("levels", p.levels, 2, 8);
  range.check("smallest_level", p.smallest_level, 0, std::max(p.levels, 1) - 1);
  range.check("tile_tolerance", p.tile_tolerance, SMALLEST, LARGEST);
  range.check("min_fill", p.min_fill, 0, 1);
  range.check("noise_percentile", p.noise_percentile, 0, 1);
  range.check("growth_percentile", p.growth_percentile, 0, 1);
  range.check("max_growth", p.max_growth, 1, LARGEST);
  range.check("long_range", p.long_range, 1, LARGEST);
  range.check("flatness", p.flatness, 0, LARGEST);
  range.check("max_flatness", p.max_flatness, 0, LARGEST);
  range.check("min_sigma", p.min_sigma, 1e-9, LARGEST);
  range.check("local_reach", p.local_reach, 0, 16);
  range.check("local_percentile", p.local_percentile, 0, 1);
  range.check("max_local", p.max_local, 1, LARGEST);
  range.check("merge_tolerance", p.merge_tolerance, SMALLEST, LARGEST);
  range.check("region_tolerance", p.region_tolerance, SMALLEST, LARGEST);
  range.check("accept_tolerance", p.accept_tolerance, SMALLEST, LARGEST);
  range.check("min_points", p.min_points, 1, 1e9);
  range.check("min_evidence", p.min_evidence, 0, 1e9);
  range.check("join_tolerance", p.join_tolerance, SMALLEST, LARGEST);
  range.check("join_gap", p.join_gap, 0, 1e4);
  range.check("join_seen", p.join_seen, 0, 1);
  range.check("fan_parts", p.fan_parts, 0, 1e6);
  range.check("fan_angle", p.fan_angle, 0, 90);
  range.check("fan_share", p.fan_share, 0, 1);
  range.check("fan_border", p.fan_border, 0, LARGEST);
  range.check("fan_gap", p.fan_gap, 0, LARGEST);
  range.check("bend_angle", p.bend_angle, 0, 720);
  range.check("support_reach", p.support_reach, 1, 512);
  range.check("none_cost", p.none_cost, SMALLEST, 1e3);
  range.check("label_change", p.label_change, 0, 1e3);
  range.check("step_sigmas", p.step_sigmas, SMALLEST, LARGEST);
  range.check("min_weight", p.min_weight, 0, 1);
  range.check("passes", p.passes, 0, 100000);
  range.check("rounds", p.rounds, 1, 10);
}

} // namespace

Parameters Parameters::fromProfile(Profile profile)
{
  Parameters parameters;
  parameters.method = profile == Profile::PAPER ? Method::PAPER : Method::ADAPTIVE;
  if (profile == Profile::FAST) {
    AdaptiveParameters& adaptive = parameters.adaptive;
    adaptive.sampling = 2;
    adaptive.levels = 3; // as large in the image as the three first of all points
    adaptive.min_points = 30;
    adaptive.min_evidence = 200.0;
  }
  return parameters;
}

std::string Parameters::validate() const
{
  RangeCheck range;
  range.check("tile_width", tile_width, 2, 4096);
  range.check("tile_height", tile_height, 2, 4096);
  range.check("noise_multiplier", noise_multiplier, 1e-6, LARGEST);
  range.check("min_valid_share", min_valid_share, 0, 1);
  range.check("beta", beta, 0, LARGEST);
  range.check("merge_threshold", merge_threshold, 0, LARGEST);
  range.check("max_planes", max_planes, 1, 4096);
  range.check("lambda", lambda, 0, LARGEST);
  range.check("tau", tau, 1e-6, LARGEST);
  range.check("gamma", gamma, 0, LARGEST);
  range.check("iterations", iterations, 0, 100000);
  range.check("convergence_tolerance", convergence_tolerance, -LARGEST, LARGEST);
  range.check("min_inliers", min_inliers, 0, 1e9);
  range.check("min_area", min_area, 0, LARGEST);
  range.check("number_of_threads", number_of_threads, 0, 1024);
  checkAdaptive(adaptive, range);
  if (!range.message().empty())
    return range.message();
  if (adaptive.fan_parts == 1)
    return "fan_parts is 1; choose 0 for off, or 2 and more: one plane is no row";
  const double probe = noise.sigma(1.0);
  if (std::isnan(probe) || std::isnan(noise.sigma(10.0)) || probe <= 0.0)
    return "noise gives no positive standard deviation at 1 m; choose a preset or "
           "coefficients a, b, c with a + b + c > 0";
  if (method == Method::ADAPTIVE && !adaptive.estimate_noise &&
      !(noise.sigma(1.0) < LARGEST && noise.sigma(10.0) < LARGEST))
    return "noise has no limit, so that every plane would fit; choose a preset other "
           "than "
           "none, or estimate the noise from the cloud";
  return {};
}

} // namespace pcl_mrf_planes
