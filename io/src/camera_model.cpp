// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"

#include <pcl_mrf_planes/io/camera_model.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::io {

namespace {

constexpr float NOT_MEASURED = std::numeric_limits<float>::quiet_NaN();
/// Half an image seen at less than 1 or more than 85 degrees is no depth camera's.
constexpr double NARROWEST = 0.0175; // tangents
constexpr double WIDEST = 11.4;

[[noreturn]] void failFit(const CameraModel& camera, const std::string& what)
{
  throw std::runtime_error("does not fit its camera (" + camera.source + "): " + what +
                           "; give the camera of this image by --camera or a "
                           "camera.json beside it");
}

std::string text(ImageSize size)
{
  return std::to_string(size.width) + " x " + std::to_string(size.height);
}

/// The same camera with images of another number of points.
CameraModel scaledTo(CameraModel camera, ImageSize size)
{
  const double factor = static_cast<double>(size.width) / camera.size.width;
  camera.fx *= factor;
  camera.fy *= factor;
  camera.cx = (camera.cx + 0.5) * factor - 0.5;
  camera.cy = (camera.cy + 0.5) * factor - 0.5;
  camera.size = size;
  return camera;
}

void checkNumbers(const CameraModel& camera)
{
  const auto positive = [](double value) {
    return std::isfinite(value) && value > 0.0;
  };
  if (!positive(camera.fx) || !positive(camera.fy))
    failFit(camera, "the focal lengths must be positive");
  if (!positive(camera.depth_scale))
    failFit(camera, "the depth scale must be positive");
}

void checkView(const CameraModel& camera, ImageSize size)
{
  if (!(camera.cx > 0.0 && camera.cx < size.width && camera.cy > 0.0 &&
        camera.cy < size.height))
    failFit(camera, "its principal point lies outside of the " + text(size) +
                        " points of the image");
  for (const double half :
       {size.width / 2.0 / camera.fx, size.height / 2.0 / camera.fy})
    if (half < NARROWEST || half > WIDEST)
      failFit(camera,
              "an image of " + text(size) + " points would be " +
                  std::to_string(std::lround(2.0 * std::atan(half) * 57.29578)) +
                  " degrees wide or high");
}

void addField(pcl::PCLPointCloud2& cloud, const char* name)
{
  pcl::PCLPointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = pcl::PCLPointField::FLOAT32;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += static_cast<std::uint32_t>(sizeof(float));
}

} // namespace

CameraModel parseCamera(const std::string& text)
{
  std::error_code error;
  if (std::filesystem::is_regular_file(text, error))
    return readCameraFile(text);
  if (text.find(',') == std::string::npos)
    return cameraPreset(text);
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    double value = 0.0;
    if (!parseNumber(part, value))
      throw std::runtime_error("the camera '" + text +
                               "' has a part that is no number; give fx,fy,cx,cy or "
                               "fx,fy,cx,cy,depth_scale");
    numbers.push_back(value);
  }
  if (numbers.size() != 4 && numbers.size() != 5)
    throw std::runtime_error("the camera '" + text + "' has " +
                             std::to_string(numbers.size()) +
                             " numbers; give fx,fy,cx,cy or fx,fy,cx,cy,depth_scale");
  CameraModel camera;
  camera.fx = numbers[0];
  camera.fy = numbers[1];
  camera.cx = numbers[2];
  camera.cy = numbers[3];
  if (numbers.size() == 5)
    camera.depth_scale = numbers[4];
  camera.source = text;
  checkNumbers(camera);
  return camera;
}

CameraModel fittedTo(const CameraModel& camera, ImageSize size)
{
  checkNumbers(camera);
  CameraModel fitted = camera;
  const bool same =
      camera.size.width == size.width && camera.size.height == size.height;
  if (camera.size.stated() && !same) {
    const bool same_shape =
        static_cast<std::int64_t>(camera.size.width) * size.height ==
        static_cast<std::int64_t>(camera.size.height) * size.width;
    if (!camera.scalable || !same_shape)
      failFit(camera, "the image has " + text(size) + " points, the camera " +
                          text(camera.size));
    fitted = scaledTo(camera, size);
  }
  checkView(fitted, size);
  return fitted;
}

DepthMap toMetres(const Image16& values, const CameraModel& camera)
{
  const bool disparity = camera.disparity_a != 0.0 && camera.disparity_b != 0.0;
  DepthMap depth(values.width, values.height, NOT_MEASURED);
  for (std::size_t i = 0; i < values.pixels.size(); ++i) {
    const std::uint16_t value = values.pixels[i];
    if (std::find(camera.invalid.begin(), camera.invalid.end(), value) !=
        camera.invalid.end())
      continue;
    const double metres = disparity ? camera.disparity_a / (camera.disparity_b - value)
                                    : value / camera.depth_scale;
    if (std::isfinite(metres) && metres > 0.0)
      depth.pixels[i] = static_cast<float>(metres);
  }
  return depth;
}

CloudFile cloudFromDepth(const DepthMap& depth, const CameraModel& camera)
{
  CloudFile file;
  file.format = PcdFormat::BINARY_COMPRESSED;
  pcl::PCLPointCloud2& cloud = file.cloud;
  for (const char* name : {"x", "y", "z"})
    addField(cloud, name);
  cloud.width = static_cast<std::uint32_t>(depth.width);
  cloud.height = static_cast<std::uint32_t>(depth.height);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 0;
  cloud.data.resize(depth.pixels.size() * cloud.point_step);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const std::size_t u = i % cloud.width;
    const std::size_t v = i / cloud.width;
    const double across = (static_cast<double>(u) - camera.cx) / camera.fx;
    const double down = (static_cast<double>(v) - camera.cy) / camera.fy;
    double z = static_cast<double>(depth.pixels[i]);
    if (camera.along_ray)
      z /= std::sqrt(1.0 + across * across + down * down);
    const float point[3] = {static_cast<float>(across * z),
                            static_cast<float>(down * z), static_cast<float>(z)};
    std::memcpy(&cloud.data[i * cloud.point_step], point, sizeof point);
  }
  return file;
}

} // namespace pcl_mrf_planes::io
