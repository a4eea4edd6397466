// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: our segmentation and others on the same clouds, time and score of
 * each. */
#include "frames.h"
#include "peer_list.h"
#include "peer_options.h"
#include "result_table.h"

#include <pcl/console/print.h>
#include <pcl/io/png_io.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>

#ifdef _OPENMP
#include <omp.h>
#endif

namespace {

using namespace pcl_mrf_planes::benchmarks;
using pcl_mrf_planes::evaluation::LabelImage;

constexpr double LONG_RUN = 2000.0; // milliseconds: is not repeated

void printList(const std::vector<Peer>& peers)
{
  for (const Peer& peer : peers) {
    std::cout << peer.name << ": " << peer.description << '\n';
    for (const Setting& setting : peer.settings) {
      std::cout << "  " << setting.name << " (" << setting.description << "):";
      for (const auto& [name, value] : setting.values)
        std::cout << ' ' << name << '=' << value;
      std::cout << '\n';
    }
  }
}

bool isWanted(const Frame& frame, const PeerOptions& options)
{
  const auto& names = options.frames;
  const bool named =
      names.empty() || std::find(names.begin(), names.end(), frame.name) != names.end();
  return named && !(options.labelled_only && frame.truth.empty());
}

/// Without ground truth only the time counts, which is compared at one size.
bool isUseful(const Frame& frame, const Cloud& cloud)
{
  return !frame.truth.empty() || (cloud.width == 640 && cloud.height == 480);
}

/// Median of the repeated runs; all of them give the same labels.
Labels timedRun(const PeerRun& run, const Cloud::ConstPtr& cloud, int repeat,
                double& milliseconds)
{
  std::vector<double> times;
  Labels labels;
  while (static_cast<int>(times.size()) < repeat) {
    labels = run.peer.segment(cloud, run.setting.values, times.emplace_back());
    if (times.back() > LONG_RUN)
      break;
  }
  std::sort(times.begin(), times.end());
  milliseconds = times[times.size() / 2];
  return labels;
}

void writeLabels(const std::string& folder, const Result& result,
                 const LabelImage& labels)
{
  const std::filesystem::path place = std::filesystem::path(folder) /
                                      (result.method + '.' + result.setting) /
                                      result.set;
  std::filesystem::create_directories(place);
  const std::string path = (place / (result.frame + ".png")).string();
  std::filesystem::remove(path);
  pcl::io::saveShortPNGFile(path, labels.labels.data(), labels.width, labels.height, 1);
  if (!std::filesystem::exists(path)) // PCL does not say
    throw std::runtime_error("cannot write '" + path + "'");
}

Result runOn(const Frame& frame, const Cloud::ConstPtr& cloud,
             const std::optional<LabelImage>& truth, const PeerRun& run,
             const PeerOptions& options)
{
  Result result;
  result.method = run.peer.name;
  result.setting = run.setting.name;
  result.set = frame.set;
  result.frame = frame.name;
  result.width = static_cast<int>(cloud->width);
  result.height = static_cast<int>(cloud->height);
  const LabelImage labels = {result.width, result.height,
                             timedRun(run, cloud, options.repeat, result.milliseconds)};
  if (truth)
    scoreAgainst(*truth, labels, result);
  if (!options.label_folder.empty())
    writeLabels(options.label_folder, result, labels);
  return result;
}

void printResult(const Result& result)
{
  std::cout << result.set << ' ' << result.frame << ' ' << result.method << ' '
            << result.setting << ": " << result.milliseconds << " ms";
  if (result.score)
    std::cout << ", pq " << result.score->pq << ", correct "
              << result.score->counts.correct << " of " << result.score->counts.truth;
  std::cout << std::endl;
}

void runAll(const std::vector<PeerRun>& runs, const PeerOptions& options)
{
  ResultFile file(options.output);
  std::vector<Result> results;
  for (const Frame& frame : listFrames(options.data, options.sets)) {
    if (!isWanted(frame, options))
      continue;
    const Cloud::ConstPtr cloud = readCloud(frame);
    if (!isUseful(frame, *cloud))
      continue;
    std::optional<LabelImage> truth;
    if (!frame.truth.empty())
      truth = readTruth(frame);
    for (const PeerRun& run : runs) {
      results.push_back(runOn(frame, cloud, truth, run, options));
      file.add(results.back());
      printResult(results.back());
    }
  }
  file.finish();
  std::cout << '\n' << summaryOf(results);
}

void useOneCore()
{
#ifdef _OPENMP
  omp_set_num_threads(1);
#endif
}

int run(int argc, const char* const argv[])
{
  const PeerOptions options = parseOptions(argc, argv);
  if (options.help) {
    std::cout << helpText();
    return 0;
  }
  const std::vector<Peer> peers = allPeers();
  for (const std::string& name : peersLeftOut())
    std::cout << "left out: " << name << '\n';
  if (options.list) {
    printList(peers);
    return 0;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); // its hints fill the screen
  useOneCore();
  runAll(chooseRuns(peers, options), options);
  return 0;
}

} // namespace

int main(int argc, char* argv[])
{
  try {
    return run(argc, argv);
  }
  catch (const UsageError& error) {
    std::cerr << "benchmark_peers: " << error.what() << '\n';
    return 2;
  }
  catch (const std::exception& error) {
    std::cerr << "benchmark_peers: " << error.what() << '\n';
    return 1;
  }
}
