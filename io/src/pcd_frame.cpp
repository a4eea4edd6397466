// SPDX-License-Identifier: BSD-3-Clause
#include "readers.h"

#include <pcl_mrf_planes/io/cloud_fields.h>

#include <cmath>
#include <cstring>

namespace pcl_mrf_planes::io {

namespace {

/// Numbers below are no planes, as in SegComp (SynPEB: segcompeval.m).
constexpr float FIRST_PLANE = 10.0f;
constexpr float LARGEST_LABEL = 65534.0f;

const pcl::PCLPointField* intensityOf(const pcl::PCLPointCloud2& cloud)
{
  for (const auto& field : cloud.fields)
    if (field.name == "intensity" && field.datatype == pcl::PCLPointField::FLOAT32)
      return &field;
  return nullptr;
}

/// The planes that SynPEB writes as intensity; empty when they are no whole numbers.
std::vector<std::uint16_t> truthOf(const pcl::PCLPointCloud2& cloud)
{
  const pcl::PCLPointField* field = intensityOf(cloud);
  if (field == nullptr)
    return {};
  std::vector<std::uint16_t> truth(static_cast<std::size_t>(cloud.width) *
                                   cloud.height);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    float value = 0.0f;
    std::memcpy(&value, &cloud.data[i * cloud.point_step + field->offset],
                sizeof value);
    if (std::isnan(value))
      continue;
    if (value < 0.0f || value > LARGEST_LABEL || value != std::floor(value))
      return {};
    truth[i] = static_cast<std::uint16_t>(value < FIRST_PLANE ? 0.0f : value);
  }
  return truth;
}

} // namespace

Frame readPcd(const std::string& path, const ReadOptions& options, bool synpeb)
{
  Frame frame;
  frame.file = readOrganizedCloud(path, options.size);
  frame.colours = colours(frame.file);
  if (synpeb)
    frame.truth = truthOf(frame.file.cloud);
  return frame;
}

} // namespace pcl_mrf_planes::io
