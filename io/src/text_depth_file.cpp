// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "readers.h"

#include <cmath>
#include <filesystem>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr const char* ENDING = ".depth";
constexpr double FARTHEST = 1e4; // metres: POV-Ray's rays that hit nothing

/// scene_00_0000.png for scene_00_0000.depth.
std::string colourBeside(const std::string& path)
{
  const std::string png =
      std::filesystem::path(path).replace_extension(".png").string();
  std::error_code error;
  return std::filesystem::is_regular_file(png, error) ? png : std::string();
}

} // namespace

Frame readTextDepth(const std::string& path, const ReadOptions& options)
{
  CameraModel camera = options.camera.value_or(cameraPreset("icl-nuim"));
  if (!camera.size.stated())
    throw std::runtime_error("has no size of its own; give a --camera that has one");
  camera.along_ray = true;
  DepthMap depth(camera.size.width, camera.size.height,
                 std::numeric_limits<float>::quiet_NaN());
  std::istringstream stream(readBytes(path));
  stream.imbue(std::locale::classic());
  std::size_t count = 0;
  for (double value = 0.0; stream >> value; ++count)
    if (count < depth.pixels.size() && value > 0.0 && value < FARTHEST)
      depth.pixels[count] = static_cast<float>(value);
  if (!stream.eof() || count != depth.pixels.size())
    throw std::runtime_error("has " + std::to_string(count) + " numbers, not " +
                             std::to_string(camera.size.width) + " x " +
                             std::to_string(camera.size.height) + "; a file " + ENDING +
                             " of ICL-NUIM has one for each point: copy it again, or "
                             "give its camera by --camera");
  Frame frame;
  frame.camera = fittedTo(camera, camera.size);
  frame.file = cloudFromDepth(depth, *frame.camera);
  frame.colours = coloursOf(colourBeside(path), camera.size);
  return frame;
}

} // namespace pcl_mrf_planes::io
