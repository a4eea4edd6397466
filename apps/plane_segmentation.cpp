// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: segments clouds and depth images into planes. */
#include "app_main.h"
#include "batch.h"
#include "command_line.h"
#include "frame_outputs.h"
#include "interruption.h"
#include "options.h"
#include "output_file.h"
#include "parameter_file.h"
#include "segmented_frame.h"
#include "stage_files.h"
#include "table.h"

#include <pcl_mrf_planes/io/frame.h>

#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace {

using namespace pcl_mrf_planes;
using namespace pcl_mrf_planes::apps;

constexpr const char* PROGRAM = "pcl_mrf_plane_segmentation";

/// The only frame of the input.
io::FrameSource singleFrame(const Options& options)
{
  std::error_code error;
  if (std::filesystem::is_directory(options.inputs[0], error))
    throw std::runtime_error("'" + options.inputs[0] +
                             "' is not a file; give --output-folder FOLDER to segment "
                             "the frames of a folder");
  io::FrameList list = io::listFrames(options.inputs, options.read);
  if (list.frames.size() != 1)
    throw std::runtime_error("'" + options.inputs[0] + "' has " +
                             std::to_string(list.frames.size()) +
                             " frames; give --output-folder FOLDER to segment them");
  io::FrameSource source = std::move(list.frames.front());
  const bool is_pcd = source.reader == "pcd" || source.reader == "synpeb";
  if (!is_pcd && sameFile(options.output, options.inputs[0]))
    throw std::runtime_error("'" + options.output +
                             "' is the input, which is no PCD; name another file for "
                             "the labelled cloud");
  return source;
}

int runSingle(const Options& options)
{
  takeInterruptions(OnInterruption::END);
  const OutputFiles files = outputsOf(options);
  checkOutputs(files);
  for (const auto& file : options.regions.files())
    if (!file.second.empty())
      checkWritable(file.second);
  const io::FrameSource source = singleFrame(options);
  const FrameAndResult all = segmentFrame(source, options);
  writeOutputs(files, {source, all.frame, *all.cloud, all.result}, options);
  if (!options.stages.empty())
    writeStages(options.stages, *all.cloud, all.frame.colours, options.parameters);
  if (options.quiet)
    return 0;
  printPlanes(std::cout, all.result);
  if (options.timing)
    printTiming(std::cout, all.result.timing);
  printSummary(std::cout, all.result, options.parameters);
  return 0;
}

int run(const Options& options)
{
  if (!options.save_parameters.empty())
    writeParameterFile(options.save_parameters, {options.profile, options.parameters});
  if (options.onlySavesParameters(options.inputs.size()))
    return 0;
  return options.batch.active() ? runBatch(options) : runSingle(options);
}

} // namespace

int main(int argc, char* argv[])
{
  return runApp({PROGRAM, "cut the cloud into parts"}, [&] {
    const Options options = parseOptions(argc, argv);
    if (options.help)
      std::cout << helpText();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      return run(options);
    return 0;
  });
}
