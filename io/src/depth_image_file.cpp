// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "readers.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace {

constexpr std::uint16_t LARGEST_DISPARITY = 2047; // 11 bits

bool isPgm(const std::string& path)
{
  return readStart(path, 2) == "P5";
}

CameraModel cameraOf(const std::string& path, const ReadOptions& options,
                     const CameraModel* fallback)
{
  if (options.camera)
    return *options.camera;
  const std::string file = findCameraFile(path);
  if (!file.empty())
    return readCameraFile(file);
  if (fallback != nullptr)
    return *fallback;
  if (isPgm(path) && isNyuDump(path))
    return cameraPreset("nyu-raw");
  throw std::runtime_error("is a depth image without a camera; give one by --camera "
                           "(kinect1, realsense, ... or fx,fy,cx,cy,depth_scale), or a "
                           "camera.json beside it");
}

/// Before the camera is looked for: that the file is a depth image at all.
Image16 readValues(const std::string& path, ByteOrder order)
{
  if (!isPgm(path))
    return readGrayPng(path, "depth images");
  int maximum = 0;
  Image16 values = readPgm(path, order, &maximum);
  if (maximum < 256)
    throw std::runtime_error("has 8 bits a point; depth images have 16");
  return values;
}

} // namespace

std::vector<Colour> coloursOf(const std::string& path, ImageSize size)
{
  if (path.empty())
    return {};
  try {
    ColourImage image = readColourImage(path);
    if (image.width == size.width && image.height == size.height)
      return std::move(image.pixels);
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception&) { // only pictures would have shown it
  }
  return {};
}

bool isNyuDump(const std::string& path)
{
  try {
    const Image16 values = readPgm(path, ByteOrder::LITTLE_ENDIAN_FIRST);
    const Image16 standard = readPgm(path, ByteOrder::BIG_ENDIAN_FIRST);
    const auto disparities = [](const Image16& image) {
      return std::all_of(image.pixels.begin(), image.pixels.end(),
                         [](std::uint16_t v) { return v <= LARGEST_DISPARITY; });
    };
    return disparities(values) && !disparities(standard);
  }
  catch (const std::runtime_error&) {
    return false;
  }
}

Frame readDepthImage(const std::string& path, const ReadOptions& options,
                     const CameraModel* fallback, const std::string& colour)
{
  Image16 values = readValues(path, ByteOrder::BIG_ENDIAN_FIRST);
  const CameraModel camera = cameraOf(path, options, fallback);
  if (camera.source == "nyu-raw" && isPgm(path))
    values = readValues(path, ByteOrder::LITTLE_ENDIAN_FIRST);
  Frame frame;
  frame.camera = fittedTo(camera, {values.width, values.height});
  frame.file = cloudFromDepth(toMetres(values, *frame.camera), *frame.camera);
  frame.colours = coloursOf(colour, {values.width, values.height});
  return frame;
}

} // namespace pcl_mrf_planes::io
