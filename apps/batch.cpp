// SPDX-License-Identifier: BSD-3-Clause
#include "batch.h"

#include "batch_summary.h"
#include "frame_outputs.h"
#include "interruption.h"
#include "progress_bar.h"
#include "segmented_frame.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace pcl_mrf_planes::apps {

namespace fs = std::filesystem;

namespace {

using Status = FrameOutcome::Status;

constexpr int SOME_FAILED = 3;
constexpr int INTERRUPTED = 130;

void createFolder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw std::runtime_error("cannot create the folder '" + folder.string() + "'" +
                             (error ? ": " + error.message() : std::string()) +
                             "; name another");
}

/// Every n-th frame: parts of a sequence are alike in their work.
std::vector<io::FrameSource> shardOf(std::vector<io::FrameSource> frames,
                                     const BatchOptions& options)
{
  std::vector<io::FrameSource> part;
  for (std::size_t i = static_cast<std::size_t>(options.shard - 1); i < frames.size();
       i += static_cast<std::size_t>(options.shards))
    part.push_back(std::move(frames[i]));
  return part;
}

std::string summaryFile(const BatchOptions& options)
{
  const std::string part = options.shards == 1
                               ? std::string()
                               : "-" + std::to_string(options.shard) + "-of-" +
                                     std::to_string(options.shards);
  return (fs::path(options.output_folder) / ("summary" + part + ".csv")).string();
}

FrameOutcome outcomeFor(const io::FrameSource& source)
{
  FrameOutcome outcome;
  outcome.name = source.name;
  outcome.input = source.input;
  outcome.reader = source.reader;
  return outcome;
}

void segmentInto(const OutputFiles& files, const io::FrameSource& source,
                 const Options& options, FrameOutcome& outcome)
{
  createFolder(fs::path(files.models).parent_path());
  const FrameAndResult all = segmentFrame(source, options);
  writeOutputs(files, {source, all.frame, *all.cloud, all.result}, options);
  outcome.numbers.planes = all.result.planes.size();
  outcome.numbers.valid_points = all.result.report.valid_points;
  outcome.numbers.labelled_share = all.result.report.labelled_share;
  outcome.numbers.ms = all.result.timing.total().median;
  outcome.status = Status::DONE;
}

void process(const io::FrameSource& source, const Options& options,
             FrameOutcome& outcome)
{
  const OutputFiles files = outputsOf(source.name, options.batch);
  try {
    if (options.batch.resume && outputsExist(files)) {
      const auto before = readReport(files.models, source.input, options);
      if (before) {
        outcome.numbers = *before;
        outcome.status = Status::RESUMED;
        return;
      }
    }
    segmentInto(files, source, options, outcome);
  }
  catch (const std::bad_alloc&) {
    outcome.status = Status::FAILED;
    outcome.message =
        "'" + source.input + "' does not fit into memory; try fewer --jobs";
  }
  catch (const std::exception& error) {
    outcome.status = Status::FAILED;
    outcome.message = error.what();
  }
}

/// Frames one after the other to each thread that asks.
void processAll(const std::vector<io::FrameSource>& frames, const Options& options,
                std::vector<FrameOutcome>& outcomes)
{
  ProgressBar bar(frames.size(), !options.quiet);
  std::mutex lock;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < frames.size() && !interrupted(); i = next++) {
      process(frames[i], options, outcomes[i]);
      const std::lock_guard<std::mutex> guard(lock);
      if (outcomes[i].status == Status::FAILED)
        bar.say("pcl_mrf_plane_segmentation: " + outcomes[i].message);
      bar.advance();
    }
  };
  std::vector<std::thread> others;
  for (int job = 1; job < options.batch.jobs; ++job)
    others.emplace_back(work);
  work();
  for (std::thread& other : others)
    other.join();
}

void printList(const std::vector<io::FrameSource>& frames)
{
  for (const io::FrameSource& frame : frames)
    std::cout << frame.name << '\t' << frame.reader << '\t' << frame.input << '\n';
}

} // namespace

int runBatch(const Options& options)
{
  io::FrameList list =
      io::listFrames(options.inputs, options.read, options.batch.output_folder);
  const std::vector<io::FrameSource> frames =
      shardOf(std::move(list.frames), options.batch);
  if (options.batch.list) {
    printList(frames);
    return 0;
  }
  createFolder(options.batch.output_folder);
  takeInterruptions(OnInterruption::FINISH);
  std::vector<FrameOutcome> outcomes;
  outcomes.reserve(frames.size());
  for (const io::FrameSource& frame : frames)
    outcomes.push_back(outcomeFor(frame));
  const auto start = std::chrono::steady_clock::now();
  processAll(frames, options, outcomes);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
  writeSummary(summaryFile(options.batch), outcomes);
  if (!options.quiet) {
    if (!list.passed_over.empty())
      std::cout << list.passed_over.size() << " files that are no frames passed over\n";
    printSummary(std::cout, outcomes, passed.count());
  }
  if (interrupted())
    return INTERRUPTED;
  return countOf(outcomes, Status::FAILED) == 0 ? 0 : SOME_FAILED;
}

} // namespace pcl_mrf_planes::apps
