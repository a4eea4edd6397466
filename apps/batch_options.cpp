// SPDX-License-Identifier: BSD-3-Clause
#include "batch_options.h"

#include "command_line.h"
#include "option_values.h"

#include <map>
#include <sstream>
#include <thread>

namespace pcl_mrf_planes::apps {

namespace po = boost::program_options;

namespace {

constexpr int MOST_JOBS = 1024;
constexpr int MOST_SHARDS = 1000000;

const std::map<std::string, FrameOutput>& outputNames()
{
  static const std::map<std::string, FrameOutput> names = {
      {"cloud", FrameOutput::CLOUD},     {"labels", FrameOutput::LABELS},
      {"overlay", FrameOutput::OVERLAY}, {"masks", FrameOutput::MASKS},
      {"ply", FrameOutput::PLY},         {"truth", FrameOutput::TRUTH},
      {"figure", FrameOutput::FIGURE}};
  return names;
}

std::set<FrameOutput> parseOutputs(const std::string& text)
{
  std::set<FrameOutput> outputs;
  std::istringstream stream(text);
  for (std::string name; std::getline(stream, name, ',');) {
    const auto found = outputNames().find(name);
    if (found == outputNames().end())
      throw UsageError(
          "--write has '" + name +
          "'; choose of cloud, labels, overlay, masks, ply, truth, figure, with "
          "commas between");
    outputs.insert(found->second);
  }
  return outputs;
}

void parseShard(const std::string& text, BatchOptions& options)
{
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos)
    throw UsageError("--shard is '" + text +
                     "'; give the part and their number, as 2/8");
  options.shards = parseInteger("shard", text.substr(slash + 1), 1, MOST_SHARDS);
  options.shard = parseInteger("shard", text.substr(0, slash), 1, options.shards);
}

} // namespace

po::options_description batchOptions()
{
  po::options_description batch("Many frames");
  batch.add_options() //
      ("output-folder", text("FOLDER"),
       "segment all frames of all inputs (files, folders, data sets, patterns) into a "
       "tree as that of the inputs; writes NAME.json and what --write says for each, "
       "and summary.csv") //
      ("write", text("LIST"),
       "with commas between: cloud (NAME.pcd), labels (NAME.labels.png), overlay "
       "(NAME.overlay.png), masks (NAME.masks/plane_001.png ...), ply (NAME.ply), "
       "truth "
       "(NAME.gt.png, where the data set has it), figure (NAME.figure.png) (default: "
       "labels)")                                                                    //
      ("inputs-from", text("FILE"), "take more inputs from a file, one a line")      //
      ("jobs", text("COUNT"), "frames at a time, 0: one for each core (default: 1)") //
      ("shard", text("I/N"), "only every N-th frame, from the I-th on")              //
      ("resume", po::bool_switch(),
       "leave out the frames whose results are there, by this version with these "
       "parameters") //
      ("list", po::bool_switch(),
       "print the names of the frames and their readers only");
  return batch;
}

BatchOptions readBatchOptions(const po::variables_map& values)
{
  BatchOptions options;
  options.output_folder = given(values, "output-folder");
  options.inputs_from = given(values, "inputs-from");
  options.resume = values["resume"].as<bool>();
  options.list = values["list"].as<bool>();
  if (values.count("write") != 0)
    options.outputs = parseOutputs(given(values, "write"));
  if (values.count("jobs") != 0)
    options.jobs = parseInteger("jobs", given(values, "jobs"), 0, MOST_JOBS);
  if (options.jobs == 0)
    options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (values.count("shard") != 0)
    parseShard(given(values, "shard"), options);
  if (options.active())
    return options;
  for (const char* name : {"write", "inputs-from", "jobs", "shard"})
    if (values.count(name) != 0)
      throw UsageError(std::string("--") + name +
                       " is for many frames; add --output-folder FOLDER");
  if (options.resume)
    throw UsageError("--resume is for many frames; add --output-folder FOLDER");
  return options;
}

} // namespace pcl_mrf_planes::apps
