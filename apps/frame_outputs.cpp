// SPDX-License-Identifier: BSD-3-Clause
#include "frame_outputs.h"

#include "output_file.h"
#include "pictures.h"
#include "plane_files.h"
#include "profile_figure.h"
#include "region_files.h"
#include "report_json.h"

#include <pcl_mrf_planes/io/cloud_fields.h>

#include <filesystem>
#include <system_error>

namespace pcl_mrf_planes::apps {

namespace fs = std::filesystem;

namespace {

void writeTruth(const std::string& path, const SegmentedFrame& segmented)
{
  const auto& truth = segmented.frame.truth;
  if (truth.size() != segmented.cloud.size())
    return;
  pcl::PointCloud<pcl::Label> labels(segmented.cloud.width, segmented.cloud.height);
  for (std::size_t i = 0; i < truth.size(); ++i)
    labels[i].label = truth[i];
  writeLabelImage(path, labels);
}

} // namespace

OutputFiles outputsOf(const Options& options)
{
  return {options.output,
          options.models,
          options.label_image,
          options.overlay,
          options.masks,
          options.ply,
          "",
          options.figure};
}

OutputFiles outputsOf(const std::string& frame_name, const BatchOptions& options)
{
  const std::string start = (fs::path(options.output_folder) / frame_name).string();
  const auto wanted = [&](FrameOutput output, const char* ending) {
    return options.outputs.count(output) != 0 ? start + ending : std::string();
  };
  OutputFiles files;
  files.cloud = wanted(FrameOutput::CLOUD, ".pcd");
  files.models = start + ".json";
  files.label_image = wanted(FrameOutput::LABELS, ".labels.png");
  files.overlay = wanted(FrameOutput::OVERLAY, ".overlay.png");
  files.masks = wanted(FrameOutput::MASKS, ".masks");
  files.ply = wanted(FrameOutput::PLY, ".ply");
  files.truth = wanted(FrameOutput::TRUTH, ".gt.png");
  files.figure = wanted(FrameOutput::FIGURE, ".figure.png");
  return files;
}

void checkOutputs(const OutputFiles& files)
{
  for (const std::string& path : {files.cloud, files.models, files.label_image,
                                  files.overlay, files.ply, files.truth, files.figure})
    if (!path.empty())
      checkWritable(path);
}

bool outputsExist(const OutputFiles& files)
{
  for (const std::string& path :
       {files.cloud, files.models, files.label_image, files.overlay, files.masks,
        files.ply, files.figure}) {
    std::error_code error;
    if (!path.empty() && !fs::exists(path, error))
      return false;
  }
  return true;
}

void writeOutputs(const OutputFiles& files, const SegmentedFrame& segmented,
                  const Options& options)
{
  const io::CloudFile& file = segmented.frame.file;
  const SegmentedCloud& result = segmented.result;
  if (!files.label_image.empty())
    writeLabelImage(files.label_image, result.labels);
  if (!files.overlay.empty())
    writePicture(files.overlay, overlay(inSensorFrame(segmented.cloud,
                                                      options.parameters.depth_measure),
                                        segmented.frame.colours, result.labels));
  if (!files.masks.empty())
    writeMasks(files.masks, result);
  if (!files.ply.empty())
    writeColouredPly(files.ply, segmented.cloud, result.labels);
  if (!files.figure.empty())
    writePicture(files.figure, profileFigure(segmented.cloud, segmented.frame.colours,
                                             options.parameters));
  if (!files.truth.empty())
    writeTruth(files.truth, segmented);
  writeRegionFiles(options.regions, file, result.labels, result.analysis);
  if (!files.cloud.empty())
    io::writeCloud(files.cloud,
                   withRegions(options.regions, io::withLabels(file, result.labels),
                               result.analysis),
                   options.format.value_or(file.format));
  if (!files.models.empty())
    writeReport(files.models, segmented, options);
}

} // namespace pcl_mrf_planes::apps
