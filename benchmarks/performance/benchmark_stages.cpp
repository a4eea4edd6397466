// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: time of every stage of each profile, or of PAPER with given numbers of
 * labels, on the 640x480 clouds of folders, by one object that goes from cloud to cloud; or the
 * whole with several numbers of threads. */
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
#include <utility>

namespace {

using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::benchmarks;
namespace po = boost::program_options;

struct StageOptions {
  bool help = false;
  std::string data, output;
  std::vector<std::string> sets;
  std::vector<int> labels;
  std::vector<unsigned int> threads;
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
  add("threads", po::value(&o.threads)->multitoken(),
      "in place of the stages: the whole by the clock with so many threads, and so "
      "many");
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
  std::size_t labels;                      ///< that a cloud must give; 0: any
  std::vector<ReusedSegmenter> segmenters; ///< one for each number of threads

  Candidate(std::string of_name, std::size_t of_labels, Parameters parameters,
            const std::vector<unsigned int>& threads)
  : name(std::move(of_name))
  , labels(of_labels)
  {
    for (const unsigned int number : threads) {
      parameters.number_of_threads = number;
      segmenters.emplace_back(parameters);
    }
  }

  /// Lets the objects meet a cloud. \return whether it gives the labels that it must give
  bool meet(const Cloud::ConstPtr& cloud)
  {
    for (ReusedSegmenter& segmenter : segmenters)
      segmenter.segment(cloud);
    return labels == 0 ||
           segmenters[0].segmentation.getReport().planes_after_merging == labels;
  }
};

std::vector<Candidate> candidates(const StageOptions& options)
{
  const std::vector<unsigned int> threads =
      options.threads.empty() ? std::vector<unsigned int>{1} : options.threads;
  std::vector<Candidate> all;
  for (const int labels : options.labels)
    all.emplace_back(std::to_string(labels), static_cast<std::size_t>(labels),
                     withLabelsOnClouds(labels), threads);
  if (all.empty())
    for (const NamedProfile& profile : allProfiles())
      all.emplace_back(profile.name, 0, Parameters::fromProfile(profile.profile),
                       threads);
  return all;
}

/// A line of the CSV. \param[in] what the stage, or the number of threads
void writeLine(const Frame& frame, const Cloud& cloud, const Candidate& candidate,
               const std::string& what, double milliseconds, std::ostream& stream)
{
  stream << frame.set << ',' << frame.name << ',' << candidate.name << ',' << what
         << ',' << milliseconds << ',' << cloud.size() << ','
         << candidate.segmenters[0].planes.size() << '\n';
}

void measureStages(const Frame& frame, const Cloud::ConstPtr& cloud, int repeat,
                   Candidate& candidate, std::ostream& stream)
{
  ReusedSegmenter& segmenter = candidate.segmenters[0];
  StageTimes times;
  for (int run = 0; run < repeat; ++run)
    addRun(segmenter, cloud, times);
  for (const std::string& name : namesOf(segmenter))
    writeLine(frame, *cloud, candidate, name, medianOf(times[name]), stream);
  std::cout << frame.set << ' ' << frame.name << ' ' << candidate.name << ": "
            << medianOf(times[WHOLE]) << " ms" << std::endl;
}

/// Runs with each number of threads one after the other: two objects in turn would drive each
/// other's memory out of the caches.
void measureThreads(const Frame& frame, const Cloud::ConstPtr& cloud,
                    const StageOptions& options, Candidate& candidate,
                    std::ostream& stream)
{
  std::cout << frame.set << ' ' << frame.name << ' ' << candidate.name << ':';
  for (std::size_t k = 0; k < options.threads.size(); ++k) {
    ReusedSegmenter& segmenter = candidate.segmenters[k];
    segmenter.segment(cloud); // not timed: brings its memory back
    StageTimes times;
    for (int run = 0; run < options.repeat; ++run)
      addRun(segmenter, cloud, times);
    const double whole = medianOf(times[WHOLE]);
    writeLine(frame, *cloud, candidate, std::to_string(options.threads[k]), whole,
              stream);
    std::cout << ' ' << whole << " ms";
  }
  std::cout << std::endl;
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
      if (!candidate.meet(cloud))
        continue;
      else if (options.threads.empty())
        measureStages(frame, cloud, options.repeat, candidate, stream);
      else
        measureThreads(frame, cloud, options, candidate, stream);
  }
  return clouds;
}

/// The CSV has its name only once it is complete.
void writeCsv(const StageOptions& options)
{
  const std::string part = options.output + ".part";
  std::ofstream stream(part);
  stream.imbue(std::locale::classic());
  stream << "set,frame,profile," << (options.threads.empty() ? "stage" : "threads")
         << ",milliseconds,points,planes\n";
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
