// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/parameter_table.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <type_traits>

namespace pcl_mrf_planes {

namespace {

using P = Parameters;
using A = AdaptiveParameters;
using Table = std::vector<ParameterEntry>;

constexpr double LARGEST = 1e6; // metres or 1/m: beyond it a value is a mistake
constexpr double SMALLEST = 1e-6;

// In the order of the enumerators.
const std::vector<std::string> SWITCH = {"false", "true"};
const std::vector<std::string> FITS = {"algebraic", "geometric"};
const std::vector<std::string> DEPTHS = {"auto", "z", "range"};
const std::vector<std::string> SMOOTHNESSES = {"potts", "dissimilarity", "hybrid",
                                               "predicted-depth"};

Table commonEntries()
{
  return {
      {"depth_measure", &P::depth_measure, 0, 2, 0, 2, "",
       "what depth is: z of the sensor (cameras), range (rotating lidars)",
       ParameterUse::ALL, DEPTHS},
      {"min_inliers", &P::min_inliers, 0, 1e9, 0, 5000, "POINTS",
       "planes with fewer points are dropped", ParameterUse::ALL},
      {"min_area", &P::min_area, 0, LARGEST, 0, 1, "M2",
       "planes with a smaller area are dropped", ParameterUse::ALL},
      {"number_of_threads", &P::number_of_threads, 0, 1024, 0, 16, "COUNT",
       "threads to use, 0 for all cores", ParameterUse::ALL},
  };
}

Table paperEntries()
{
  return {
      {"tile_width", &P::tile_width, 2, 4096, 4, 80, "POINTS", "width of a tile",
       ParameterUse::PAPER},
      {"tile_height", &P::tile_height, 2, 4096, 4, 80, "POINTS", "height of a tile",
       ParameterUse::PAPER},
      {"fit", &P::fit, 0, 1, 0, 1, "", "least-squares fit of a tile's plane",
       ParameterUse::PAPER, FITS},
      {"noise_multiplier", &P::noise_multiplier, 1e-6, LARGEST, 0.25, 8, "FACTOR",
       "how many sigma a tile's rms distance may reach; larger keeps more tiles",
       ParameterUse::PAPER},
      {"min_valid_share", &P::min_valid_share, 0, 1, 0, 1, "SHARE",
       "share of a tile's points that must be valid, 0 to 1", ParameterUse::PAPER},
      {"beta", &P::beta, 0, LARGEST, 0, 2, "1/M",
       "weight of the offsets' difference in a plane dissimilarity, per metre",
       ParameterUse::PAPER},
      {"merge_threshold", &P::merge_threshold, 0, LARGEST, 0, 1, "NUMBER",
       "dissimilarity below which planes are merged; larger merges more",
       ParameterUse::PAPER},
      {"max_planes", &P::max_planes, 1, 4096, 1, 256, "COUNT",
       "label planes kept at most", ParameterUse::PAPER},
      {"lambda", &P::lambda, 0, LARGEST, 0, 2, "1/M",
       "weight of the data term, per metre", ParameterUse::PAPER},
      {"tau", &P::tau, 1e-6, LARGEST, 0.01, 2, "METRES",
       "distance at which the data term is cut off", ParameterUse::PAPER},
      {"smoothness", &P::smoothness, 0, 3, 0, 3, "", "price of two labels side by side",
       ParameterUse::PAPER, SMOOTHNESSES},
      {"gamma", &P::gamma, 0, LARGEST, 0, 1, "NUMBER",
       "price of a label change for potts", ParameterUse::PAPER},
      {"iterations", &P::iterations, 0, 100000, 0, 20, "COUNT",
       "iterations of belief propagation", ParameterUse::PAPER},
      {"convergence_tolerance", &P::convergence_tolerance, -LARGEST, LARGEST, -1, 1,
       "ENERGY", "stop early once no message changes by more; negative: never",
       ParameterUse::PAPER},
      {"compute_energy", &P::compute_energy, 0, 1, 0, 1, "",
       "record the energy of every iteration (slower)", ParameterUse::PAPER, SWITCH},
  };
}

Table adaptiveEntries()
{
  return {
      {"sampling", &A::sampling, 1, 8, 1, 4, "STEP",
       "every so many-th point and row is segmented, the others follow them",
       ParameterUse::ADAPTIVE},
      {"least_samples", &A::least_samples, 0, 1e9, 0, 80000, "POINTS",
       "the step of sampling is shorter where it would leave fewer",
       ParameterUse::ADAPTIVE},
      {"levels", &A::levels, 2, 8, 2, 6, "COUNT",
       "tile sizes, each twice the one before", ParameterUse::ADAPTIVE},
      {"smallest_level", &A::smallest_level, 0, 7, 0, 3, "COUNT",
       "tile sizes that are left out, from 4 points on", ParameterUse::ADAPTIVE},
      {"tile_tolerance", &A::tile_tolerance, SMALLEST, LARGEST, 0.5, 6, "SIGMAS",
       "rms distance that a tile may have", ParameterUse::ADAPTIVE},
      {"min_fill", &A::min_fill, 0, 1, 0.2, 1, "SHARE",
       "of valid points that a tile needs", ParameterUse::ADAPTIVE},
      {"noise_percentile", &A::noise_percentile, 0, 1, 0.1, 0.9, "SHARE",
       "percentile of the tiles' rms distances that is the cloud's noise",
       ParameterUse::ADAPTIVE},
      {"growth_percentile", &A::growth_percentile, 0, 1, 0.1, 0.9, "SHARE",
       "percentile of the growth of the rms distance from tile size to tile size",
       ParameterUse::ADAPTIVE},
      {"max_growth", &A::max_growth, 1, LARGEST, 1, 3, "FACTOR", "largest such growth",
       ParameterUse::ADAPTIVE},
      {"long_range", &A::long_range, 1, LARGEST, 1, 4, "FACTOR",
       "noise of large planes over the largest tiles', if it is correlated",
       ParameterUse::ADAPTIVE},
      {"flatness", &A::flatness, 0, LARGEST, 0, 0.05, "SHARE",
       "of its extent that a plane may bend; larger takes in warped surfaces",
       ParameterUse::ADAPTIVE},
      {"max_flatness", &A::max_flatness, 0, LARGEST, 0, 0.02, "METRES",
       "that a plane may bend at most", ParameterUse::ADAPTIVE},
      {"flatness_noise", &A::flatness_noise, 0, LARGEST, 0, 0.01, "METRES",
       "noise of the points that allows all of max-flatness", ParameterUse::ADAPTIVE},
      {"quiet_flatness", &A::quiet_flatness, 0, 1, 0, 1, "SHARE",
       "of max-flatness that is left without noise; 1: off", ParameterUse::ADAPTIVE},
      {"min_sigma", &A::min_sigma, 1e-9, LARGEST, 1e-6, 1e-3, "METRES",
       "least noise at 1 m", ParameterUse::ADAPTIVE},
      {"local_reach", &A::local_reach, 0, 16, 0, 8, "TILES",
       "window of the local noise", ParameterUse::ADAPTIVE},
      {"local_percentile", &A::local_percentile, 0, 1, 0, 1, "SHARE",
       "percentile of the tiles' rms distances in that window", ParameterUse::ADAPTIVE},
      {"max_local", &A::max_local, 1, LARGEST, 1, 10, "FACTOR",
       "local noise over the cloud's, at most", ParameterUse::ADAPTIVE},
      {"merge_tolerance", &A::merge_tolerance, SMALLEST, LARGEST, 0.5, 12, "SIGMAS",
       "deviation of the smaller part when planes merge; larger merges more",
       ParameterUse::ADAPTIVE},
      {"region_tolerance", &A::region_tolerance, SMALLEST, LARGEST, 0.5, 6, "SIGMAS",
       "rms distance that a plane may have", ParameterUse::ADAPTIVE},
      {"accept_tolerance", &A::accept_tolerance, SMALLEST, LARGEST, 0.5, 6, "SIGMAS",
       "the same for what is labelled", ParameterUse::ADAPTIVE},
      {"min_points", &A::min_points, 1, 1e9, 4, 1000, "POINTS",
       "smallest plane; more are asked for where noise is correlated",
       ParameterUse::ADAPTIVE},
      {"min_evidence", &A::min_evidence, 0, 1e9, 0, 5000, "NATS",
       "points times ln(width / rms distance) that a plane needs; larger keeps fewer "
       "small ones",
       ParameterUse::ADAPTIVE},
      {"join_coplanar", &A::join_coplanar, 0, 1, 0, 1, "",
       "whether parts of one plane behind an occluder share a label",
       ParameterUse::ADAPTIVE, SWITCH},
      {"join_tolerance", &A::join_tolerance, SMALLEST, LARGEST, 0.5, 8, "SIGMAS",
       "merge-tolerance of parts that do not touch", ParameterUse::ADAPTIVE},
      {"join_gap", &A::join_gap, 0, 1e4, 0, 8, "FACTOR",
       "widest gap over the side of the smaller part", ParameterUse::ADAPTIVE},
      {"join_seen", &A::join_seen, 0, 1, 0, 0.5, "SHARE",
       "of the way between them that may be off the plane", ParameterUse::ADAPTIVE},
      {"join_over_occluders", &A::join_over_occluders, 0, 1, 0, 1, "",
       "whether what stands in front leaves parts joined", ParameterUse::ADAPTIVE,
       SWITCH},
      {"fan_parts", &A::fan_parts, 0, 1e6, 0, 8, "COUNT",
       "so many small planes in a row are a curved surface; 0: off",
       ParameterUse::ADAPTIVE},
      {"fan_angle", &A::fan_angle, 0, 90, 0, 60, "DEGREES",
       "largest crease in such a row", ParameterUse::ADAPTIVE},
      {"fan_share", &A::fan_share, 0, 1, 0, 0.02, "SHARE",
       "of the points above which a plane is never taken for curved",
       ParameterUse::ADAPTIVE},
      {"fan_border", &A::fan_border, 0, LARGEST, 0, 2, "FACTOR",
       "common border over the side of the smaller part", ParameterUse::ADAPTIVE},
      {"fan_gap", &A::fan_gap, 0, LARGEST, 0, 10, "SIGMAS",
       "step across a smooth border", ParameterUse::ADAPTIVE},
      {"fan_ring", &A::fan_ring, 0, 2, 0.5, 1.5, "SHARE",
       "of a plane's border in such creases, both ways, that makes it curved; above 1: "
       "off",
       ParameterUse::ADAPTIVE},
      {"bend_angle", &A::bend_angle, 0, 720, 2, 90, "DEGREES",
       "turn of the normal that makes a region curved, if nothing else is in it",
       ParameterUse::ADAPTIVE},
      {"support_reach", &A::support_reach, 1, 512, 1, 16, "4 POINTS",
       "how far from its cells a plane competes", ParameterUse::ADAPTIVE},
      {"none_cost", &A::none_cost, SMALLEST, 1e3, 0.5, 10, "SIGMAS",
       "cost of a point on no plane; larger labels more", ParameterUse::ADAPTIVE},
      {"label_change", &A::label_change, 0, 1e3, 0, 10, "SIGMAS",
       "price of a label change on a smooth surface", ParameterUse::ADAPTIVE},
      {"step_sigmas", &A::step_sigmas, SMALLEST, LARGEST, 0.5, 30, "SIGMAS",
       "depth step over which that price falls", ParameterUse::ADAPTIVE},
      {"min_weight", &A::min_weight, 0, 1, 0, 1, "SHARE",
       "of that price left across a step", ParameterUse::ADAPTIVE},
      {"passes", &A::passes, 0, 100000, 0, 5, "COUNT",
       "belief propagation down the image and up again", ParameterUse::ADAPTIVE},
      {"rounds", &A::rounds, 1, 10, 1, 5, "COUNT",
       "of labelling and refitting, all but the last on cells of 4x4 points",
       ParameterUse::ADAPTIVE},
  };
}

/// The struct that a member belongs to.
template <typename Value, typename Owner, typename All>
auto& owner(Value Owner::*, All& parameters)
{
  if constexpr (std::is_same_v<Owner, AdaptiveParameters>)
    return parameters.adaptive;
  else
    return parameters;
}

std::string printNumber(double value)
{
  for (int digits = 6;; ++digits) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    double back = 0.0;
    if (digits >= std::numeric_limits<double>::max_digits10 ||
        (text >> back && back == value))
      return text.str();
  }
}

} // namespace

bool ParameterEntry::isWhole() const
{
  return !std::holds_alternative<double Parameters::*>(member) &&
         !std::holds_alternative<double AdaptiveParameters::*>(member);
}

bool ParameterEntry::isUsedBy(Method method) const
{
  return use == ParameterUse::ALL ||
         (use == ParameterUse::PAPER) == (method == Method::PAPER);
}

double ParameterEntry::get(const Parameters& parameters) const
{
  return std::visit(
      [&](auto value) { return static_cast<double>(owner(value, parameters).*value); },
      member);
}

void ParameterEntry::set(Parameters& parameters, double value) const
{
  const double inside = value >= low ? std::min(value, high) : low; // NaN: low
  std::visit(
      [&](auto place) {
        auto& target = owner(place, parameters).*place;
        using Value = std::remove_reference_t<decltype(target)>;
        if constexpr (std::is_same_v<Value, bool>)
          target = inside >= 1.0;
        else if constexpr (std::is_enum_v<Value>)
          target = static_cast<Value>(static_cast<int>(inside));
        else
          target = static_cast<Value>(inside);
      },
      member);
}

std::string ParameterEntry::print(const Parameters& parameters) const
{
  const double value = get(parameters);
  if (!choices.empty())
    return choices.at(static_cast<std::size_t>(value));
  return isWhole() ? std::to_string(static_cast<long long>(value)) : printNumber(value);
}

const std::vector<ParameterEntry>& parameterTable()
{
  static const Table table = [] {
    Table all = commonEntries();
    for (const Table& more : {paperEntries(), adaptiveEntries()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return table;
}

const ParameterEntry* findParameter(const std::string& name)
{
  const Table& table = parameterTable();
  const auto found =
      std::find_if(table.begin(), table.end(),
                   [&](const ParameterEntry& entry) { return entry.name == name; });
  return found == table.end() ? nullptr : &*found;
}

} // namespace pcl_mrf_planes
