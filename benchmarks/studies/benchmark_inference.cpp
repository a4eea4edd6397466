// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: how near the labels of the profile DEFAULT come to the least energy
 * of its random field, after how many passes. */
#include "frames.h"
#include "output_file.h"
#include "parallel.h"

#include "reference/candidate_fields.h"
#include "reference/lower_bound.h"
#include "reference/potts_grid.h"

#include <boost/program_options.hpp>

#include <cstdint>
#include <fstream>
#include <iostream>
#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace po = boost::program_options;
using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::benchmarks;
namespace reference = pcl_mrf_planes::adaptive::reference;

constexpr int ROOMS = 6;
const std::vector<int> PASSES = {0, 1, 2, 3, 5, 10, 50};

struct Options {
  bool help = false;
  std::string data, output;
  std::vector<std::string> sets;
  unsigned int threads = 2;
  int iterations = 100;
};

po::options_description describe(Options& o)
{
  po::options_description all("Options");
  auto add = all.add_options();
  add("help,h", po::bool_switch(&o.help), "print this and exit");
  add("data", po::value(&o.data),
      "folder of sets: SET/NAME.pcd with ground truth; without it generated rooms "
      "only");
  add("output", po::value(&o.output)->default_value("inference.csv"), "CSV to write");
  add("sets", po::value(&o.sets)->multitoken(), "these sets only");
  add("threads", po::value(&o.threads)->default_value(2), "frames at a time");
  add("iterations", po::value(&o.iterations)->default_value(100),
      "of the dual ascent that finds the lower bound");
  return all;
}

OrganizedPoints readPoints(const Frame& frame)
{
  const Cloud::Ptr cloud = readCloud(frame);
  OrganizedPoints points;
  points.resize(static_cast<int>(cloud->width), static_cast<int>(cloud->height));
  for (std::size_t i = 0; i < points.size(); ++i)
    points.set(i, (*cloud)[i].x, (*cloud)[i].y, (*cloud)[i].z);
  points.resolveDepthMeasure(DepthMeasure::AUTO);
  return points;
}

double activeShare(const adaptive::CandidateField& field)
{
  return static_cast<double>(field.active.size()) /
         static_cast<double>(field.number.size());
}

double lowerBound(const adaptive::CandidateField& field, int iterations)
{
  const reference::PottsGrid grid = reference::toPottsGrid(field);
  reference::LowerBound bound(grid);
  for (int k = 0; k < iterations; ++k)
    bound.iterate();
  return bound.bound();
}

/// Lines of the CSV: one for each number of passes.
std::string measure(const std::string& names, const OrganizedPoints& points,
                    int iterations)
{
  const reference::CloudField cloud(points, {});
  const double bound = lowerBound(cloud.field, iterations);
  std::ostringstream lines;
  lines.imbue(std::locale::classic());
  lines.precision(12);
  for (const int passes : PASSES) {
    const auto labels = adaptive::propagateBeliefs(cloud.field, points, passes);
    lines << names << ',' << activeShare(cloud.field) << ',' << passes << ','
          << reference::energyOf(cloud.field, points, labels) << ',' << bound << '\n';
  }
  return lines.str();
}

std::string measureRoom(std::uint64_t seed, int iterations)
{
  const OrganizedPoints points =
      pcl_mrf_planes::reference::toPoints(pcl_mrf_planes::reference::takePicture(
          "room", 640, 480, seed, scenes::SensorNoise::kinect()));
  return measure("rooms,room " + std::to_string(seed), points, iterations);
}

std::vector<Frame> labelledFrames(const Options& options)
{
  std::vector<Frame> frames;
  if (!options.data.empty())
    for (const Frame& frame : listFrames(options.data, options.sets))
      if (!frame.truth.empty())
        frames.push_back(frame);
  return frames;
}

void runAll(const Options& options)
{
  const std::vector<Frame> frames = labelledFrames(options);
  std::vector<std::string> lines(frames.size() + ROOMS);
  doAll(lines.size(), options.threads, [&](std::size_t i) {
    lines[i] = i < frames.size()
                   ? measure(frames[i].set + ',' + frames[i].name,
                             readPoints(frames[i]), options.iterations)
                   : measureRoom(i - frames.size() + 1, options.iterations);
    std::cout << lines[i] << std::flush;
  });
  apps::writeAtomically(options.output, [&](const std::string& path) {
    std::ofstream file(path);
    file << "set,frame,active_share,passes,energy,bound\n";
    for (const std::string& text : lines)
      file << text;
    file.close();
    if (!file)
      throw std::runtime_error("cannot write '" + path + "'");
  });
}

int run(int argc, char* argv[])
{
  Options options;
  const po::options_description all = describe(options);
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, all), values);
  po::notify(values);
  if (options.help) {
    std::cout << "benchmark_inference [options]\n\n"
                 "Energy of the labels after some passes of belief propagation, and a\n"
                 "lower bound on the least energy there is; writes a CSV.\n\n"
              << all;
    return 0;
  }
  runAll(options);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    return run(argc, argv);
  }
  catch (const po::error& error) {
    std::cerr << "benchmark_inference: " << error.what()
              << "; --help lists the options\n";
    return 2;
  }
  catch (const std::exception& error) {
    std::cerr << "benchmark_inference: " << error.what() << '\n';
    return 1;
  }
}
