// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_sliders.h"

#include <algorithm>
#include <cmath>

namespace pcl_mrf_planes::viewer {

namespace {

using P = Parameters;

int whole(double value)
{
  return static_cast<int>(std::lround(value));
}

/// The noise of 2 m, where most indoor points are; one number moves the whole model.
constexpr double NOISE_DEPTH = 2.0;

ParameterSlider noiseSlider()
{
  return {"noise at 2 m, mm",
          0.5,
          40.0,
          false,
          [](const P& p) { return 1000.0 * p.noise.sigma(NOISE_DEPTH); },
          [](P& p, double mm) {
            const double factor = mm / (1000.0 * p.noise.sigma(NOISE_DEPTH));
            p.noise = {p.noise.a * factor, p.noise.b * factor, p.noise.c * factor};
            p.adaptive.estimate_noise = false;
          }};
}

ParameterSlider tileSlider()
{
  return {"tile size, points",
          4,
          100,
          true,
          [](const P& p) { return static_cast<double>(p.tile_width); },
          [](P& p, double v) { p.tile_width = p.tile_height = whole(v); }};
}

std::vector<ParameterSlider> paperSliders()
{
  return {tileSlider(),
          {"merge threshold v", 0.0, 1.0, false,
           [](const P& p) { return p.merge_threshold; },
           [](P& p, double v) { p.merge_threshold = v; }},
          {"beta, 1/m", 0.0, 4.0, false, [](const P& p) { return p.beta; },
           [](P& p, double v) { p.beta = v; }},
          {"lambda, 1/m", 0.0, 4.0, false, [](const P& p) { return p.lambda; },
           [](P& p, double v) { p.lambda = v; }},
          {"tau, m", 0.01, 2.0, false, [](const P& p) { return p.tau; },
           [](P& p, double v) { p.tau = v; }},
          {"iterations", 0, 50, true,
           [](const P& p) { return static_cast<double>(p.iterations); },
           [](P& p, double v) { p.iterations = whole(v); }},
          noiseSlider(),
          {"smallest plane, points", 0, 10000, true,
           [](const P& p) { return static_cast<double>(p.min_inliers); },
           [](P& p, double v) { p.min_inliers = whole(v); }}};
}

ParameterSlider adaptive(const char* title, double AdaptiveParameters::*value,
                         double low, double high)
{
  return {title,
          low,
          high,
          false,
          [=](const P& p) { return p.adaptive.*value; },
          [=](P& p, double v) { p.adaptive.*value = v; }};
}

std::vector<ParameterSlider> adaptiveSliders()
{
  using A = AdaptiveParameters;
  return {adaptive("least evidence, nats", &A::min_evidence, 0.0, 2000.0),
          adaptive("merge tolerance, sigmas", &A::merge_tolerance, 0.5, 8.0),
          adaptive("flatness, share", &A::flatness, 0.0, 0.05),
          adaptive("cost of no plane, sigmas", &A::none_cost, 0.5, 10.0),
          adaptive("label change, sigmas", &A::label_change, 0.0, 10.0),
          {"passes", 1, 10, true,
           [](const P& p) { return static_cast<double>(p.adaptive.passes); },
           [](P& p, double v) { p.adaptive.passes = whole(v); }},
          noiseSlider(),
          {"smallest plane, points", 0, 10000, true,
           [](const P& p) { return static_cast<double>(p.min_inliers); },
           [](P& p, double v) { p.min_inliers = whole(v); }}};
}

} // namespace

const std::vector<ParameterSlider>& slidersOf(Method method)
{
  static const std::vector<ParameterSlider> paper = paperSliders();
  static const std::vector<ParameterSlider> adaptive_ones = adaptiveSliders();
  return method == Method::PAPER ? paper : adaptive_ones;
}

void moveSlider(const ParameterSlider& slider, double value, Parameters& parameters)
{
  const double inside = std::min(slider.high, std::max(slider.low, value));
  slider.set(parameters, slider.whole ? std::round(inside) : inside);
}

} // namespace pcl_mrf_planes::viewer
