// SPDX-License-Identifier: BSD-3-Clause
#include "label_file.h"

#include "png_labels.h"

#include <pcl_mrf_planes/io/cloud_fields.h>
#include <pcl_mrf_planes/io/cloud_file.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace pcl_mrf_planes::evaluation {

namespace fs = std::filesystem;

namespace {

template <typename T>
std::int64_t load(const std::uint8_t* bytes)
{
  T value{};
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<std::int64_t>(value);
}

std::int64_t loadInteger(const std::uint8_t* bytes, std::uint8_t type)
{
  using Field = pcl::PCLPointField;
  switch (type) {
  case Field::INT8:
    return load<std::int8_t>(bytes);
  case Field::UINT8:
    return load<std::uint8_t>(bytes);
  case Field::INT16:
    return load<std::int16_t>(bytes);
  case Field::UINT16:
    return load<std::uint16_t>(bytes);
  case Field::INT32:
    return load<std::int32_t>(bytes);
  case Field::UINT32:
    return load<std::uint32_t>(bytes);
  default:
    throw std::runtime_error("has a field 'label' that is no whole number; write it as "
                             "an unsigned integer");
  }
}

LabelImage labelsOf(const pcl::PCLPointCloud2& cloud)
{
  const auto field =
      std::find_if(cloud.fields.begin(), cloud.fields.end(),
                   [](const auto& candidate) { return candidate.name == "label"; });
  if (field == cloud.fields.end())
    throw std::runtime_error("has no field 'label'; segment it first");
  LabelImage image;
  image.width = static_cast<int>(cloud.width);
  image.height = static_cast<int>(cloud.height);
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  for (std::size_t i = 0; i < points; ++i) {
    const std::int64_t label =
        loadInteger(&cloud.data[i * cloud.point_step + field->offset], field->datatype);
    if (label < 0 || label > UINT16_MAX)
      throw std::runtime_error("has the label " + std::to_string(label) +
                               "; give labels from 0 to 65535");
    image.labels.push_back(static_cast<std::uint16_t>(label));
  }
  return image;
}

void checkIsFile(const std::string& path)
{
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    throw std::runtime_error("does not exist; check the name");
  if (fs::is_directory(status))
    throw std::runtime_error("is a folder; name a file, or give folders by --truth "
                             "and --labels");
}

/// Puts the file's name in front of what is wrong with it.
template <typename Work>
auto about(const std::string& path, const Work& work)
{
  try {
    return work();
  }
  catch (const std::bad_alloc&) {
    throw;
  }
  catch (const std::exception& error) {
    throw std::runtime_error("'" + path + "' " + error.what());
  }
}

} // namespace

LabelImage readLabels(const std::string& path)
{
  about(path, [&] { checkIsFile(path); });
  if (fs::path(path).extension() != ".pcd")
    return about(path, [&] { return readLabelPng(path); });
  const io::CloudFile file = io::readOrganizedCloud(path);
  return about(path, [&] { return labelsOf(file.cloud); });
}

OrganizedPoints readPoints(const std::string& path)
{
  const io::CloudFile file = io::readOrganizedCloud(path);
  const auto cloud = about(path, [&] { return io::coordinates(file); });
  const auto first = std::find_if(cloud->begin(), cloud->end(), [](const auto& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
  OrganizedPoints points;
  points.resize(static_cast<int>(cloud->width), static_cast<int>(cloud->height));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto& p = (*cloud)[i];
    points.set(i, p.x - first->x, p.y - first->y, p.z - first->z);
  }
  return points;
}

} // namespace pcl_mrf_planes::evaluation
