// SPDX-License-Identifier: BSD-3-Clause
#include "plane_files.h"

#include "label_colours.h"
#include "output_file.h"
#include "pictures.h"

#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::apps {

namespace fs = std::filesystem;

namespace {

std::string maskFile(const std::string& folder, std::size_t label)
{
  char name[32];
  std::snprintf(name, sizeof name, "plane_%03zu.png", label);
  return (fs::path(folder) / name).string();
}

bool isFinite(const pcl::PointXYZ& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

template <typename T>
void append(std::string& bytes, T value)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

std::string plyHeader(std::size_t points)
{
  const std::uint16_t one = 1;
  std::uint8_t first = 0;
  std::memcpy(&first, &one, 1);
  return std::string("ply\nformat binary_") + (first == 1 ? "little" : "big") +
         "_endian 1.0\nelement vertex " + std::to_string(points) +
         "\nproperty float x\nproperty float y\nproperty float z\n"
         "property uchar red\nproperty uchar green\nproperty uchar blue\n"
         "property uint label\nend_header\n";
}

} // namespace

void writeMasks(const std::string& folder, const SegmentedCloud& result)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot create the folder '" + folder +
                             "': " + error.message() + "; name another");
  const std::size_t planes = result.planes.size();
  std::vector<unsigned char> mask(result.labels.size());
  for (std::size_t label = 1; label <= planes; ++label) {
    for (std::size_t i = 0; i < mask.size(); ++i)
      mask[i] = result.labels[i].label == label ? 255 : 0;
    writeMask(maskFile(folder, label), mask, static_cast<int>(result.labels.width),
              static_cast<int>(result.labels.height));
  }
  for (std::size_t label = planes + 1; fs::remove(maskFile(folder, label), error);)
    ++label;
}

void writeColouredPly(const std::string& path,
                      const pcl::PointCloud<pcl::PointXYZ>& cloud,
                      const pcl::PointCloud<pcl::Label>& labels)
{
  std::string body;
  std::size_t points = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!isFinite(cloud[i]))
      continue;
    ++points;
    append(body, cloud[i].x);
    append(body, cloud[i].y);
    append(body, cloud[i].z);
    for (const std::uint8_t channel : labelColour(labels[i].label))
      append(body, channel);
    append(body, labels[i].label);
  }
  writeBytes(path, plyHeader(points) + body);
}

} // namespace pcl_mrf_planes::apps
