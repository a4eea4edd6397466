// SPDX-License-Identifier: BSD-3-Clause
/** \file Command line: segments a PCD file into planes. */
#include "cloud_fields.h"
#include "cloud_file.h"
#include "options.h"
#include "output_file.h"
#include "pictures.h"
#include "region_files.h"
#include "report_json.h"
#include "segmented_cloud.h"
#include "table.h"

#include <pcl/console/print.h>

#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

namespace {

using namespace pcl_mrf_planes::apps;

constexpr const char* PROGRAM = "pcl_mrf_plane_segmentation";
constexpr int FAILURE = 1;
constexpr int WRONG_USAGE = 2;

/// Puts the input's name in front of what is wrong with it.
template <typename Work>
auto aboutInput(const Options& options, const Work& work)
{
  try {
    return work();
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception& error) {
    throw std::runtime_error("'" + options.input + "' " + error.what());
  }
}

/// Before the work: an output that cannot be written is found early.
void checkOutputs(const Options& options)
{
  for (const std::string& path :
       {options.output, options.models, options.label_image, options.overlay})
    if (!path.empty())
      checkWritable(path);
  for (const auto& file : options.regions.files())
    if (!file.second.empty())
      checkWritable(file.second);
}

void writeOutputs(const Options& options, const CloudFile& file,
                  const pcl::PointCloud<pcl::PointXYZ>& cloud,
                  const SegmentedCloud& result)
{
  if (!options.models.empty())
    writeReport(options.models, result, options);
  if (!options.label_image.empty())
    writeLabelImage(options.label_image, result.labels);
  if (!options.overlay.empty())
    writePicture(options.overlay,
                 overlay(inSensorFrame(cloud, options.parameters.depth_measure),
                         colours(file), result.labels));
  writeRegionFiles(options.regions, file, result.labels, result.analysis);
  if (!options.output.empty())
    writeCloud(
        options.output,
        withRegions(options.regions, withLabels(file, result.labels), result.analysis),
        options.format.value_or(file.format));
}

void run(const Options& options)
{
  checkOutputs(options);
  const CloudFile file = readOrganizedCloud(options.input);
  const auto cloud = aboutInput(options, [&] { return coordinates(file); });
  const SegmentedCloud result = aboutInput(options, [&] {
    return segmentCloud(cloud, options.parameters, options.repeat, options.regions);
  });
  writeOutputs(options, file, *cloud, result);
  if (options.quiet)
    return;
  printPlanes(std::cout, result);
  if (options.timing)
    printTiming(std::cout, result.timing);
  printSummary(std::cout, result, options.parameters);
  if (!std::cout.flush())
    throw std::runtime_error("cannot write to standard output");
}

} // namespace

int main(int argc, char* argv[])
{
  // What PCL would print is said by the messages below, with what to do about it.
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  try {
    const Options options = parseOptions(argc, argv);
    if (options.help)
      std::cout << helpText();
    else if (options.version)
      std::cout << PROGRAM << ' ' << PCL_MRF_PLANES_VERSION << '\n';
    else
      run(options);
    return 0;
  }
  catch (const UsageError& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
    return WRONG_USAGE;
  }
  catch (const std::bad_alloc&) {
    std::cerr << PROGRAM << ": not enough memory; cut the cloud into parts\n";
  }
  catch (const std::exception& error) {
    std::cerr << PROGRAM << ": " << error.what() << '\n';
  }
  return FAILURE;
}
