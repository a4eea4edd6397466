// SPDX-License-Identifier: BSD-3-Clause
#include "parameter_options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace pcl_mrf_planes::apps {

namespace {

template <typename Enum>
using Names = std::vector<std::pair<std::string, Enum>>;

template <typename Enum>
std::vector<std::string> words(const Names<Enum>& names)
{
  std::vector<std::string> result;
  for (const auto& name : names)
    result.push_back(name.first);
  return result;
}

template <typename Enum>
Enum parseName(const std::string& option, const std::string& text,
               const Names<Enum>& names)
{
  for (const auto& name : names)
    if (name.first == text)
      return name.second;
  throw UsageError("--" + option + " is '" + text + "'; choose one of " +
                   join(words(names)));
}

const Names<Profile> PROFILES = {
    {"default", Profile::DEFAULT}, {"fast", Profile::FAST}, {"paper", Profile::PAPER}};
const Names<PlaneFit> FITS = {{"algebraic", PlaneFit::ALGEBRAIC},
                              {"geometric", PlaneFit::GEOMETRIC}};
const Names<DepthMeasure> DEPTHS = {{"auto", DepthMeasure::AUTO},
                                    {"z", DepthMeasure::OPTICAL_AXIS},
                                    {"range", DepthMeasure::RANGE}};
const Names<Smoothness> SMOOTHNESSES = {
    {"potts", Smoothness::POTTS},
    {"dissimilarity", Smoothness::DISSIMILARITY},
    {"hybrid", Smoothness::HYBRID},
    {"predicted-depth", Smoothness::PREDICTED_DEPTH}};
const Names<bool> SWITCH = {{"true", true}, {"false", false}};

NoiseModel parseNoise(const std::string& option, const std::string& text)
{
  NoiseModel model;
  if (NoiseModel::fromName(text, model))
    return model;
  std::vector<double> numbers;
  std::istringstream parts(text);
  double value = 0.0;
  for (std::string part; std::getline(parts, part, ',');)
    if (parseNumber(part, value) && std::isfinite(value))
      numbers.push_back(value);
    else
      break;
  const auto commas =
      static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
  if (numbers.size() == 1 && commas == 0)
    return NoiseModel::fixed(numbers[0]);
  if (numbers.size() == 3 && commas == 2)
    return {numbers[0], numbers[1], numbers[2]};
  throw UsageError("--" + option + " is '" + text + "'; choose one of " +
                   join(NoiseModel::names()) +
                   ", or give metres (0.01) or coefficients a,b,c (0.001,0,0.0014)");
}

std::string printNoise(const NoiseModel& noise)
{
  for (const std::string& name : NoiseModel::names()) {
    NoiseModel preset;
    if (NoiseModel::fromName(name, preset) && preset.a == noise.a &&
        preset.b == noise.b && preset.c == noise.c)
      return name;
  }
  if (noise.b == 0.0 && noise.c == 0.0)
    return printReal(noise.a);
  return printReal(noise.a) + ',' + printReal(noise.b) + ',' + printReal(noise.c);
}

/// The part of the parameters that a member belongs to.
template <typename Owner, typename All>
auto& part(All& parameters)
{
  if constexpr (std::is_same_v<Owner, AdaptiveParameters>)
    return parameters.adaptive;
  else
    return parameters;
}

template <typename Owner>
ParameterOption real(const char* name, double Owner::*value, const char* argument,
                     const char* help)
{
  return {name, argument, help,
          [=](Parameters& p, const std::string& text) {
            part<Owner>(p).*value = parseReal(name, text);
          },
          [=](const Parameters& p) { return printReal(part<Owner>(p).*value); }};
}

template <typename Owner>
ParameterOption integer(const char* name, int Owner::*value, const char* argument,
                        const char* help)
{
  return {name, argument, help,
          [=](Parameters& p, const std::string& text) {
            part<Owner>(p).*value =
                parseInteger(name, text, std::numeric_limits<int>::min(),
                             std::numeric_limits<int>::max());
          },
          [=](const Parameters& p) { return std::to_string(part<Owner>(p).*value); }};
}

template <typename Owner, typename Enum>
ParameterOption choice(const char* name, Enum Owner::*value, const Names<Enum>& names,
                       const char* help)
{
  const bool is_switch =
      std::is_same_v<Enum, bool> && std::is_same_v<Owner, Parameters>;
  return {name, is_switch ? "" : join(words(names), "|"), help,
          [=](Parameters& p, const std::string& text) {
            part<Owner>(p).*value = parseName(name, text, names);
          },
          [=](const Parameters& p) {
            for (const auto& entry : names)
              if (entry.second == part<Owner>(p).*value)
                return entry.first;
            return std::string();
          }};
}

} // namespace

namespace {

/// What Method::ADAPTIVE takes.
std::vector<ParameterOption> adaptiveOptions()
{
  using A = AdaptiveParameters;
  return {
      integer("sampling", &A::sampling, "STEP",
              "every so many-th point and row is segmented, the others follow them"),
      integer("levels", &A::levels, "COUNT", "tile sizes, each twice the one before"),
      integer("smallest-level", &A::smallest_level, "COUNT",
              "tile sizes that are left out, from 4 points on"),
      real("tile-tolerance", &A::tile_tolerance, "SIGMAS",
           "rms distance that a tile may have"),
      real("min-fill", &A::min_fill, "SHARE", "of valid points that a tile needs"),
      real("noise-percentile", &A::noise_percentile, "SHARE",
           "percentile of the tiles' rms distances that is the cloud's noise"),
      real("growth-percentile", &A::growth_percentile, "SHARE",
           "percentile of the growth of the rms distance from tile size to tile size"),
      real("max-growth", &A::max_growth, "FACTOR", "largest such growth"),
      real("long-range", &A::long_range, "FACTOR",
           "noise of large planes over the largest tiles', if it is correlated"),
      real("flatness", &A::flatness, "SHARE",
           "of its extent that a plane may bend; larger takes in warped surfaces"),
      real("max-flatness", &A::max_flatness, "METRES", "that a plane may bend at most"),
      real("min-sigma", &A::min_sigma, "METRES", "least noise at 1 m"),
      integer("local-reach", &A::local_reach, "TILES", "window of the local noise"),
      real("local-percentile", &A::local_percentile, "SHARE",
           "percentile of the tiles' rms distances in that window"),
      real("max-local", &A::max_local, "FACTOR",
           "local noise over the cloud's, at most"),
      real("merge-tolerance", &A::merge_tolerance, "SIGMAS",
           "deviation of the smaller part when planes merge; larger merges more"),
      real("region-tolerance", &A::region_tolerance, "SIGMAS",
           "rms distance that a plane may have"),
      real("accept-tolerance", &A::accept_tolerance, "SIGMAS",
           "the same for what is labelled"),
      integer("min-points", &A::min_points, "POINTS",
              "smallest plane; more are asked for where noise is correlated"),
      real("min-evidence", &A::min_evidence, "NATS",
           "points times ln(width / rms distance) that a plane needs; larger keeps "
           "fewer small ones"),
      choice("join-coplanar", &A::join_coplanar, SWITCH,
             "whether parts of one plane behind an occluder share a label"),
      real("join-tolerance", &A::join_tolerance, "SIGMAS",
           "merge-tolerance of parts that do not touch"),
      real("join-gap", &A::join_gap, "FACTOR",
           "widest gap over the side of the smaller part"),
      real("join-seen", &A::join_seen, "SHARE",
           "of the way between them that may be off the plane"),
      choice("join-over-occluders", &A::join_over_occluders, SWITCH,
             "whether what stands in front leaves parts joined"),
      integer("fan-parts", &A::fan_parts, "COUNT",
              "so many small planes in a row are a curved surface; 0: off"),
      real("fan-angle", &A::fan_angle, "DEGREES", "largest crease in such a row"),
      real("fan-share", &A::fan_share, "SHARE",
           "of the points above which a plane is never taken for curved"),
      real("fan-border", &A::fan_border, "FACTOR",
           "common border over the side of the smaller part"),
      real("fan-gap", &A::fan_gap, "SIGMAS", "step across a smooth border"),
      real("bend-angle", &A::bend_angle, "DEGREES",
           "turn of the normal that makes a region curved, if nothing else is in it"),
      integer("support-reach", &A::support_reach, "4 POINTS",
              "how far from its cells a plane competes"),
      real("none-cost", &A::none_cost, "SIGMAS",
           "cost of a point on no plane; larger labels more"),
      real("label-change", &A::label_change, "SIGMAS",
           "price of a label change on a smooth surface"),
      real("step-sigmas", &A::step_sigmas, "SIGMAS",
           "depth step over which that price falls"),
      real("min-weight", &A::min_weight, "SHARE", "of that price left across a step"),
      integer("passes", &A::passes, "COUNT",
              "belief propagation down the image and up again"),
      integer("rounds", &A::rounds, "COUNT",
              "of labelling and refitting, all but the last on cells of 4x4 points")};
}

/// What Method::PAPER takes.
std::vector<ParameterOption> paperOptions()
{
  using P = Parameters;
  return {
      integer("tile-width", &P::tile_width, "POINTS", "width of a tile"),
      integer("tile-height", &P::tile_height, "POINTS", "height of a tile"),
      choice("fit", &P::fit, FITS, "least-squares fit of a tile's plane"),
      real("noise-multiplier", &P::noise_multiplier, "FACTOR",
           "how many sigma a tile's rms distance may reach; larger keeps more tiles"),
      real("min-valid-share", &P::min_valid_share, "SHARE",
           "share of a tile's points that must be valid, 0 to 1"),
      real("beta", &P::beta, "1/M",
           "weight of the offsets' difference in a plane dissimilarity, per metre"),
      real("merge-threshold", &P::merge_threshold, "NUMBER",
           "dissimilarity below which planes are merged; larger merges more"),
      integer("max-planes", &P::max_planes, "COUNT", "label planes kept at most"),
      real("lambda", &P::lambda, "1/M", "weight of the data term, per metre"),
      real("tau", &P::tau, "METRES", "distance at which the data term is cut off"),
      choice("smoothness", &P::smoothness, SMOOTHNESSES,
             "price of two labels side by side"),
      real("gamma", &P::gamma, "NUMBER", "price of a label change for potts"),
      integer("iterations", &P::iterations, "COUNT",
              "iterations of belief propagation"),
      real("convergence-tolerance", &P::convergence_tolerance, "ENERGY",
           "stop early once no message changes by more; negative: never"),
      choice("energy", &P::compute_energy, SWITCH,
             "record the energy of every iteration (slower)")};
}

void setNoise(Parameters& p, const std::string& text)
{
  p.adaptive.estimate_noise = text == "auto";
  if (text == "auto" && p.method == Method::PAPER)
    throw UsageError("--noise is auto; the paper's method takes a preset, metres, or "
                     "a,b,c, see --help");
  if (text != "auto")
    p.noise = parseNoise("noise", text);
}

std::string printUsedNoise(const Parameters& p)
{
  return p.method == Method::ADAPTIVE && p.adaptive.estimate_noise
             ? "auto"
             : printNoise(p.noise);
}

std::vector<ParameterOption> commonOptions()
{
  using P = Parameters;
  return {
      choice("depth", &P::depth_measure, DEPTHS,
             "what depth is: z of the sensor (cameras), range (rotating lidars)"),
      {"noise", "auto|NAME|METRES|A,B,C",
       "sensor noise sigma(z): auto, estimated from the cloud (profile default); " +
           join(NoiseModel::names()) +
           "; the same number of metres at every depth; or the coefficients of "
           "a + b z + c z^2",
       setNoise, printUsedNoise},
      integer("min-inliers", &P::min_inliers, "POINTS",
              "planes with fewer points are dropped"),
      real("min-area", &P::min_area, "M2", "planes with a smaller area are dropped"),
      {"threads", "COUNT", "threads to use, 0 for all cores",
       [](P& p, const std::string& text) {
         p.number_of_threads =
             static_cast<unsigned int>(parseInteger("threads", text, 0, 1024));
       },
       [](const P& p) { return std::to_string(p.number_of_threads); }}};
}

} // namespace

const std::vector<ParameterOption>& commonParameterOptions()
{
  static const std::vector<ParameterOption> all = commonOptions();
  return all;
}

const std::vector<ParameterOption>& parameterOptions(Method method)
{
  static const std::vector<ParameterOption> paper = paperOptions();
  static const std::vector<ParameterOption> adaptive = adaptiveOptions();
  return method == Method::PAPER ? paper : adaptive;
}

std::vector<std::string> profileNames()
{
  return words(PROFILES);
}

Profile profileFromName(const std::string& name)
{
  return parseName("profile", name, PROFILES);
}

void checkParameters(const Parameters& parameters)
{
  std::string complaint = parameters.validate();
  if (complaint.empty())
    return;
  // "tile_width is 1; choose ..." becomes "--tile-width is 1; choose ...".
  const std::size_t end = std::min(complaint.find(' '), complaint.size());
  std::replace(complaint.begin(), complaint.begin() + static_cast<std::ptrdiff_t>(end),
               '_', '-');
  throw UsageError("--" + complaint);
}

} // namespace pcl_mrf_planes::apps
