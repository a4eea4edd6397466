// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"

#include <pcl_mrf_planes/io/camera_model.h>

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

namespace {

constexpr const char* ENDINGS[] = {".json", ".yaml", ".yml"};
constexpr std::size_t LARGEST_FILE = 1 << 20;

/// A number by any of its names; false when none is there.
bool take(const YAML::Node& root, const std::vector<std::string>& names, double& value)
{
  for (const std::string& name : names)
    if (root[name] && root[name].IsScalar()) {
      if (!parseNumber(root[name].Scalar(), value))
        throw std::runtime_error(name + " is '" + root[name].Scalar() +
                                 "', not a number");
      return true;
    }
  return false;
}

bool takePinhole(const YAML::Node& root, CameraModel& camera)
{
  return take(root, {"fx", "Camera.fx", "focal_length_x"}, camera.fx) &&
         take(root, {"fy", "Camera.fy", "focal_length_y"}, camera.fy) &&
         take(root, {"cx", "Camera.cx", "ppx", "principal_point_x"}, camera.cx) &&
         take(root, {"cy", "Camera.cy", "ppy", "principal_point_y"}, camera.cy);
}

/// Nine numbers of a matrix: fx at 0, fy at 4, cx and cy where they are said to be.
bool takeMatrix(const YAML::Node& matrix, std::size_t cx, std::size_t cy,
                CameraModel& camera)
{
  if (!matrix || !matrix.IsSequence() || matrix.size() != 9)
    return false;
  camera.fx = matrix[0].as<double>();
  camera.fy = matrix[4].as<double>();
  camera.cx = matrix[cx].as<double>();
  camera.cy = matrix[cy].as<double>();
  return true;
}

CameraModel parse(const std::string& text)
{
  const YAML::Node root = YAML::Load(text);
  if (!root.IsMap())
    throw std::runtime_error("has no names and values");
  CameraModel camera;
  const bool found =
      takePinhole(root, camera) ||
      (root["camera_matrix"] && root["camera_matrix"].IsMap() &&
       takeMatrix(root["camera_matrix"]["data"], 2, 5, camera)) || // ROS, row by row
      takeMatrix(root["K"], 2, 5, camera) ||
      takeMatrix(root["intrinsic_matrix"], 6, 7, camera); // Open3D, column by column
  if (!found)
    throw std::runtime_error("has no fx, fy, cx and cy, camera_matrix, K or "
                             "intrinsic_matrix");
  double width = 0.0, height = 0.0;
  if (take(root, {"width", "image_width", "Camera.width"}, width) &&
      take(root, {"height", "image_height", "Camera.height"}, height))
    camera.size = {static_cast<int>(std::clamp(width, 0.0, 1e6)),
                   static_cast<int>(std::clamp(height, 0.0, 1e6))};
  take(root, {"depth_scale", "DepthMapFactor", "depthmap_factor"}, camera.depth_scale);
  if (root["invalid"] && root["invalid"].IsSequence())
    camera.invalid = root["invalid"].as<std::vector<std::uint16_t>>();
  return camera;
}

/// Without OpenCV's first line, "%YAML:1.0", which is none of YAML's.
std::string withoutDirective(const std::string& text)
{
  return text.compare(0, 6, "%YAML:") == 0 ? text.substr(text.find('\n') + 1) : text;
}

/// What the image is called without .depth.png or its last ending.
std::string nameOf(const fs::path& image)
{
  const fs::path stem = image.stem();
  return stem.extension() == ".depth" ? stem.stem().string() : stem.string();
}

} // namespace

CameraModel readCameraFile(const std::string& path)
{
  try {
    const std::string text = readStart(path, LARGEST_FILE);
    CameraModel camera = parse(withoutDirective(text));
    camera.source = path;
    return camera;
  }
  catch (const YAML::Exception& error) {
    throw std::runtime_error("camera file '" + path + "' cannot be understood (" +
                             error.what() + "); write it as JSON or YAML");
  }
  catch (const std::exception& error) {
    throw std::runtime_error("camera file '" + path + "' " + error.what() +
                             "; write fx, fy, cx, cy and depth_scale");
  }
}

std::string findCameraFile(const std::string& image)
{
  const fs::path folder = fs::path(image).parent_path();
  std::error_code error;
  for (const std::string& name : {nameOf(image) + ".camera", std::string("camera")})
    for (const char* ending : ENDINGS) {
      const fs::path file = folder / (name + ending);
      if (fs::is_regular_file(file, error))
        return file.string();
    }
  return {};
}

} // namespace pcl_mrf_planes::io
