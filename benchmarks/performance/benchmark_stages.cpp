// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: time of every stage of each profile, or of PAPER with given numbers of
 * labels, on the 640x480 clouds of folders, by one object that goes from cloud to cloud. */
#include "frames.h"
#include "paper_labels.h"
#include "profiles.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <locale>
#include <map>
#include <stdexcept>

namespace {

using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::benchmarks;
namespace po = boost::program_options;

struct StageOptions {
  bool help = false;
  std::string data, output;
  std::vector<std::string> sets;
  std::vector<int> labels;
  int width = 640, height = 480;
  int repeat = 9;
};

/// Times of a profile on a cloud, run by run, by the name of the stage.
using StageTimes = std::map<std::string, std::vector<double>>;

/// A stage that has no name of its own: what the class does besides.
constexpr const char* OUTPUT = "output";
constexpr const char* WHOLE = "whole";         ///< by the clock
constexpr const char* PROCESSOR = "processor"; ///< of the whole

po::options_description describe(StageOptions& o)
{
  po::options_description all("Options");
  auto add = all.add_options();
  add("help,h", po::bool_switch(&o.help), "print this and exit");
  add("data", po::value(&o.data),
      "folder of sets: SET/NAME.pcd; otherwise the environment's PCL_MRF_PLANES_DATA");
  add("output", po::value(&o.output)->default_value("stages.csv"), "CSV to write");
  add("sets", po::value(&o.sets)->multitoken(), "these sets only");
  add("labels", po::value(&o.labels)->multitoken(),
      "in place of the profiles: PAPER with so many labels, where a cloud gives them");
  add("width", po::value(&o.width), "of the clouds that count, otherwise 640");
  add("height", po::value(&o.height), "of the clouds that count, otherwise 480");
  add("repeat", po::value(&o.repeat),
      "runs on a cloud, otherwise 9; the median counts");
  return all;
}

StageOptions parse(int argc, const char* const argv[])
{
  StageOptions options;
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, describe(options)), values);
  po::notify(values);
  if (options.data.empty())
    if (const char* folder = std::getenv("PCL_MRF_PLANES_DATA"))
      options.data = folder;
  if (options.data.empty() && !options.help)
    throw po::error("name the folder of the clouds by --data or PCL_MRF_PLANES_DATA");
  if (options.repeat < 1)
    throw po::error("--repeat must be at least 1");
  return options;
}

void addRun(ReusedSegmenter& segmenter, const Cloud::ConstPtr& cloud, StageTimes& times)
{
  const auto start = std::chrono::steady_clock::now();
  const Stopwatch processor;
  segmenter.segment(cloud);
  times[PROCESSOR].push_back(processor.milliseconds());
  const double whole = std::chrono::duration<double, std::milli>(
                           std::chrono::steady_clock::now() - start)
                           .count();
  const auto& report = segmenter.segmentation.getReport();
  for (const auto& [stage, milliseconds] : report.stage_ms)
    times[stage].push_back(milliseconds);
  times[OUTPUT].push_back(whole - report.totalMs());
  times[WHOLE].push_back(whole);
}

double medianOf(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The stages in their order, then the rest.
std::vector<std::string> namesOf(const ReusedSegmenter& segmenter)
{
  std::vector<std::string> names;
  for (const auto& stage : segmenter.segmentation.getReport().stage_ms)
    names.push_back(stage.first);
  names.insert(names.end(), {OUTPUT, WHOLE, PROCESSOR});
  return names;
}

/// What is measured: a profile, or PAPER with a number of labels.
struct Candidate {
  std::string name;
  std::size_t labels; ///< that a cloud must give; 0: any
  ReusedSegmenter segmenter;
};

std::vector<Candidate> candidates(const StageOptions& options)
{
  std::vector<Candidate> all;
  for (const int labels : options.labels)
    all.push_back({std::to_string(labels), static_cast<std::size_t>(labels),
                   ReusedSegmenter(withLabelsOnClouds(labels))});
  if (all.empty())
    for (const NamedProfile& profile : allProfiles())
      all.push_back(
          {profile.name, 0, ReusedSegmenter(Parameters::fromProfile(profile.profile))});
  return all;
}

void measure(const Frame& frame, const Cloud::ConstPtr& cloud, int repeat,
             Candidate& candidate, std::ostream& stream)
{
  ReusedSegmenter& segmenter = candidate.segmenter;
  segmenter.segment(cloud); // not timed: the object meets the cloud
  if (candidate.labels != 0 &&
      segmenter.segmentation.getReport().planes_after_merging != candidate.labels)
    return;
  StageTimes times;
  for (int run = 0; run < repeat; ++run)
    addRun(segmenter, cloud, times);
  for (const std::string& name : namesOf(segmenter))
    stream << frame.set << ',' << frame.name << ',' << candidate.name << ',' << name
           << ',' << medianOf(times[name]) << ',' << cloud->size() << ','
           << segmenter.planes.size() << '\n';
  std::cout << frame.set << ' ' << frame.name << ' ' << candidate.name << ": "
            << medianOf(times[WHOLE]) << " ms" << std::endl;
}

/// \return how many clouds there were
int measureAll(const StageOptions& options, std::ostream& stream)
{
  std::vector<Candidate> all = candidates(options);
  int clouds = 0;
  for (const Frame& frame : listFrames(options.data, options.sets)) {
    const Cloud::ConstPtr cloud = readCloud(frame);
    if (static_cast<int>(cloud->width) != options.width ||
        static_cast<int>(cloud->height) != options.height)
      continue;
    ++clouds;
    for (Candidate& candidate : all)
      measure(frame, cloud, options.repeat, candidate, stream);
  }
  return clouds;
}

/// The CSV has its name only once it is complete.
void writeCsv(const StageOptions& options)
{
  const std::string part = options.output + ".part";
  std::ofstream stream(part);
  stream.imbue(std::locale::classic());
  stream << "set,frame,profile,stage,milliseconds,points,planes\n";
  if (measureAll(options, stream) == 0)
    throw std::runtime_error("no cloud of the size asked for in '" + options.data +
                             "'");
  stream.close();
  if (!stream)
    throw std::runtime_error("cannot write '" + part + "'");
  std::filesystem::rename(part, options.output);
}

int run(int argc, const char* const argv[])
{
  const StageOptions options = parse(argc, argv);
  if (options.help) {
    StageOptions unused;
    std::cout << "benchmark_stages [options]\n\n" << describe(unused);
    return 0;
  }
  writeCsv(options);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    return run(argc, argv);
  }
  catch (const po::error& error) {
    std::cerr << "benchmark_stages: " << error.what() << "; --help lists the options\n";
    return 2;
  }
  catch (const std::exception& error) {
    std::cerr << "benchmark_stages: " << error.what() << '\n';
    return 1;
  }
}
