// SPDX-License-Identifier: BSD-3-Clause
#include "stage_files.h"

#include "colour_track.h"
#include "label_colours.h"
#include "option_values.h"
#include "output_file.h"

#include <pcl_mrf_planes/mrf_plane_segmentation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::apps {

namespace {

SegmentationStages stagesOf(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                            const Parameters& parameters)
{
  pcl::MRFPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setParameters(parameters);
  segmentation.setInputCloud(pcl::PointCloud<pcl::PointXYZ>::ConstPtr(
      new pcl::PointCloud<pcl::PointXYZ>(cloud)));
  std::vector<pcl::ModelCoefficients> models;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(models, inliers);
  SegmentationStages stages;
  segmentation.computeStages(stages);
  if (stages.labels.empty())
    throw std::runtime_error(
        "--stages: there is not enough memory for all labels of all "
        "points; cut the cloud into parts");
  return stages;
}

/// Fit error that nearly all tiles stay below.
double largeError(const std::vector<StageTile>& tiles)
{
  std::vector<double> errors;
  for (const StageTile& tile : tiles)
    if (tile.kept)
      errors.push_back(tile.rms);
  if (errors.empty())
    return 0.0;
  const std::size_t rank = (errors.size() - 1) * 19 / 20;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(rank),
                   errors.end());
  return errors[rank];
}

/// Tiles that are kept, from green to red by their errors, with dark borders.
void paintTile(const StageTile& tile, double large, Picture& picture)
{
  constexpr double GREEN = 120.0; // degrees
  const double share = large > 0.0 ? std::min(1.0, tile.rms / large) : 0.0;
  const Colour colour = colourFromHue(GREEN * (1.0 - share), 0.8, 0.5);
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const int i = y * picture.width + x;
      Colour& pixel = picture.pixels[static_cast<std::size_t>(i)];
      const bool border = x == tile.x || y == tile.y;
      for (std::size_t c = 0; c < colour.size(); ++c)
        pixel[c] = static_cast<std::uint8_t>(
            border ? pixel[c] / 3 : (2 * pixel[c] + 3 * colour[c]) / 5);
    }
}

Picture tilePicture(const OrganizedPoints& points, const std::vector<Colour>& colours,
                    const std::vector<StageTile>& tiles)
{
  Picture picture = sight(points, colours);
  const double large = largeError(tiles);
  for (const StageTile& tile : tiles)
    if (tile.kept)
      paintTile(tile, large, picture);
  return picture;
}

pcl::PointCloud<pcl::Label> colourNumbers(const StageLabels& after, int width,
                                          int height, ColourTrack& track)
{
  const std::vector<std::uint32_t> numbers = track.update(after.planes, after.labels);
  pcl::PointCloud<pcl::Label> labels(static_cast<std::uint32_t>(width),
                                     static_cast<std::uint32_t>(height));
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i].label = after.labels[i] == 0 ? 0 : numbers[after.labels[i] - 1U];
  return labels;
}

std::string pictureName(std::size_t number, const StageLabels& after)
{
  std::string digits = std::to_string(number);
  if (digits.size() < 2)
    digits.insert(0, "0");
  const bool counted = after.stage == Stage::ITERATION || after.stage == Stage::CELLS;
  return digits + '_' + stageName(after.stage) +
         (counted ? '_' + std::to_string(after.count) : "") + ".png";
}

std::string stageLine(const StageLabels& after, const std::string& picture)
{
  std::vector<bool> seen(after.planes.size() + 1, false);
  for (const std::uint16_t label : after.labels)
    seen[label] = true;
  const auto planes = std::count(seen.begin() + 1, seen.end(), true);
  const auto free = std::count(after.labels.begin(), after.labels.end(), 0);
  std::string line = picture + ',' + stageName(after.stage) + ',' +
                     std::to_string(after.count) + ',' + std::to_string(planes) + ',' +
                     std::to_string(static_cast<long long>(after.labels.size()) - free);
  if (!after.energy.has_value())
    return line + ",,,\n";
  for (const double part :
       {after.energy->data, after.energy->smoothness, after.energy->total()})
    line += ',' + printReal(part);
  return line + '\n';
}

std::string tileTable(const std::vector<StageTile>& tiles)
{
  std::string text = "x,y,width,height,kept,rms,plane,a,b,c,d\n";
  for (const StageTile& tile : tiles) {
    for (const int number : {tile.x, tile.y, tile.width, tile.height})
      text += std::to_string(number) + ',';
    text += tile.kept ? "1," : "0,";
    text += tile.kept ? printReal(tile.rms) + ',' : ",";
    text += tile.merged >= 0 ? std::to_string(tile.merged + 1) : "";
    for (int axis = 0; axis < 4; ++axis)
      text += ',' + (tile.kept ? printReal(tile.plane.coefficient(axis)) : "");
    text += '\n';
  }
  return text;
}

void makeFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot create the folder '" + folder +
                             "': " + error.message() + "; name another");
}

} // namespace

void writeStages(const std::string& folder, const pcl::PointCloud<pcl::PointXYZ>& cloud,
                 const std::vector<Colour>& colours, const Parameters& parameters)
{
  makeFolder(folder);
  const auto file = [&](const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
  };
  const SegmentationStages stages = stagesOf(cloud, parameters);
  const OrganizedPoints points = inSensorFrame(cloud, parameters.depth_measure);
  writePicture(file("00_tiles.png"), tilePicture(points, colours, stages.tiles));
  writeBytes(file("tiles.csv"), tileTable(stages.tiles));
  std::string table =
      "picture,stage,count,planes,labelled_points,data,smoothness,energy\n";
  ColourTrack track;
  for (std::size_t k = 0; k < stages.labels.size(); ++k) {
    const StageLabels& after = stages.labels[k];
    const std::string name = pictureName(k + 1, after);
    const auto labels = colourNumbers(after, stages.width, stages.height, track);
    writePicture(file(name), labelPanel(points, colours, labels));
    table += stageLine(after, name);
  }
  writeBytes(file("stages.csv"), table);
}

} // namespace pcl_mrf_planes::apps
