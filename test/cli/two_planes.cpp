// SPDX-License-Identifier: BSD-3-Clause
#include "two_planes.h"

#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace pcl_mrf_planes::test {

namespace {

constexpr float FOCAL_LENGTH = 150.0f; // points
constexpr float WALL = 2.0f;           // metres
/// Height of the camera over the floor, such that the floor begins at FLOOR_ROW.
constexpr float FLOOR =
    WALL * (TwoPlanes::FLOOR_ROW - TwoPlanes::HEIGHT / 2) / FOCAL_LENGTH;

Eigen::Vector3f seen(std::size_t i)
{
  const auto column = static_cast<float>(i % TwoPlanes::WIDTH);
  const auto row = static_cast<float>(i / TwoPlanes::WIDTH);
  const Eigen::Vector3f ray((column - TwoPlanes::WIDTH / 2) / FOCAL_LENGTH,
                            (row - TwoPlanes::HEIGHT / 2) / FOCAL_LENGTH, 1.0f);
  return ray * (TwoPlanes::label(i) == 1 ? WALL : FLOOR / ray.y());
}

} // namespace

TwoPlanes::TwoPlanes()
{
  using Field = pcl::PCLPointField;
  for (const char* name : {"x", "y", "z", "rgb"})
    addField(cloud, name, Field::FLOAT32, 1, 4);
  addField(cloud, "ring", Field::UINT16, 1, 2);
  addField(cloud, "time", Field::FLOAT64, 1, 8);
  addField(cloud, "tag", Field::UINT8, 3, 1);
  addField(cloud, "label", Field::FLOAT32, 1, 4); // to be replaced, type and all
  cloud.width = WIDTH;
  cloud.height = HEIGHT;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 0;
  cloud.data.resize(POINTS * cloud.point_step);
  for (std::size_t i = 0; i < POINTS; ++i) {
    Eigen::Vector3f p = orientation * seen(i) + origin.head<3>();
    if (!valid(i))
      p.setConstant(std::numeric_limits<float>::quiet_NaN());
    setField(cloud, i, "x", p.x());
    setField(cloud, i, "y", p.y());
    setField(cloud, i, "z", p.z());
    setField(cloud, i, "rgb", colour(i));
    setField(cloud, i, "ring", static_cast<std::uint16_t>(i % 65521));
    setField(cloud, i, "time", 1.7e9 + static_cast<double>(i) / 3.0);
    for (std::size_t k = 0; k < 3; ++k)
      setField(cloud, i, "tag", static_cast<std::uint8_t>((i + 7 * k) % 256), k);
    setField(cloud, i, "label", -1.5f);
  }
}

bool TwoPlanes::valid(std::size_t i)
{
  return i % 50 != 0 && (i % WIDTH >= 12 || i / WIDTH >= 9);
}

std::uint32_t TwoPlanes::colour(std::size_t i)
{
  const auto column = static_cast<std::uint32_t>(i % WIDTH);
  const auto row = static_cast<std::uint32_t>(i / WIDTH);
  return 0xff000000u | ((40 + column) << 16) | ((100 + row) << 8) | 33u;
}

void TwoPlanes::write(const std::string& path, const std::string& format) const
{
  pcl::PCDWriter writer;
  int status = -1;
  if (format == "ascii")
    status = writer.writeASCII(path, cloud, origin, orientation, 17);
  else if (format == "binary")
    status = writer.writeBinary(path, cloud, origin, orientation);
  else if (format == "binary_compressed")
    status = writer.writeBinaryCompressed(path, cloud, origin, orientation);
  if (status < 0)
    throw std::runtime_error("cannot write the test's input " + path);
}

const pcl::PCLPointField* findField(const pcl::PCLPointCloud2& cloud,
                                    const std::string& name)
{
  const auto found =
      std::find_if(cloud.fields.begin(), cloud.fields.end(),
                   [&](const auto& field) { return field.name == name; });
  return found == cloud.fields.end() ? nullptr : &*found;
}

void addField(pcl::PCLPointCloud2& cloud, const std::string& name,
              std::uint8_t datatype, std::uint32_t count, std::uint32_t size)
{
  pcl::PCLPointField field;
  field.name = name;
  field.datatype = datatype;
  field.count = count;
  field.offset = cloud.point_step;
  cloud.point_step += count * size;
  cloud.fields.push_back(field);
}

} // namespace pcl_mrf_planes::test
