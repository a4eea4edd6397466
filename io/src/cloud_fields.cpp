// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_mrf_planes/io/cloud_fields.h>

#include <pcl/common/io.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>

namespace pcl_mrf_planes::io {

namespace {

constexpr const char* LABEL = "label";

const pcl::PCLPointField* findField(const pcl::PCLPointCloud2& cloud,
                                    const std::string& name)
{
  for (const auto& field : cloud.fields)
    if (field.name == name)
      return &field;
  return nullptr;
}

/// Reads one number of each point.
class Coordinate {
public:
  Coordinate(const pcl::PCLPointCloud2& cloud, const char* name)
  : field_(findField(cloud, name))
  {
    if (field_ == nullptr)
      throw std::runtime_error(std::string("has no field '") + name +
                               "'; a cloud with x, y and z is needed");
    if ((field_->datatype != pcl::PCLPointField::FLOAT32 &&
         field_->datatype != pcl::PCLPointField::FLOAT64) ||
        field_->count != 1)
      throw std::runtime_error(std::string("has a field '") + name +
                               "' that is not one float or double; convert it to "
                               "floats in metres");
  }

  float read(const std::uint8_t* point) const
  {
    if (field_->datatype == pcl::PCLPointField::FLOAT64) {
      double value = 0.0;
      std::memcpy(&value, point + field_->offset, sizeof value);
      return static_cast<float>(value);
    }
    float value = 0.0f;
    std::memcpy(&value, point + field_->offset, sizeof value);
    return value;
  }

private:
  const pcl::PCLPointField* field_;
};

std::size_t pointCount(const pcl::PCLPointCloud2& cloud)
{
  return static_cast<std::size_t>(cloud.width) * cloud.height;
}

std::size_t sizeOf(const pcl::PCLPointField& field)
{
  return static_cast<std::size_t>(pcl::getFieldSize(field.datatype)) * field.count;
}

} // namespace

pcl::PointCloud<pcl::PointXYZ>::Ptr coordinates(const CloudFile& file)
{
  const Coordinate x(file.cloud, "x");
  const Coordinate y(file.cloud, "y");
  const Coordinate z(file.cloud, "z");
  pcl::PointCloud<pcl::PointXYZ>::Ptr result(
      new pcl::PointCloud<pcl::PointXYZ>(file.cloud.width, file.cloud.height));
  result->sensor_origin_ = file.origin;
  result->sensor_orientation_ = file.orientation;
  std::size_t finite = 0;
  for (std::size_t i = 0; i < result->size(); ++i) {
    const std::uint8_t* bytes = &file.cloud.data[i * file.cloud.point_step];
    auto& point = (*result)[i];
    point.x = x.read(bytes);
    point.y = y.read(bytes);
    point.z = z.read(bytes);
    finite += std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z)
                  ? 1
                  : 0;
  }
  result->is_dense = finite == result->size();
  if (finite == 0)
    throw std::runtime_error("has no valid point, all coordinates are NaN or "
                             "infinite; give it a cloud with measurements");
  return result;
}

std::vector<Colour> colours(const CloudFile& file)
{
  const auto* field = findField(file.cloud, "rgb");
  if (field == nullptr)
    field = findField(file.cloud, "rgba");
  if (field == nullptr || sizeOf(*field) != 4)
    return {};
  std::vector<Colour> result(pointCount(file.cloud));
  for (std::size_t i = 0; i < result.size(); ++i) {
    std::uint32_t packed = 0;
    std::memcpy(&packed, &file.cloud.data[i * file.cloud.point_step + field->offset],
                sizeof packed);
    for (std::size_t channel = 0; channel < 3; ++channel)
      result[i][channel] =
          static_cast<std::uint8_t>((packed >> (16 - 8 * channel)) & 0xff);
  }
  return result;
}

namespace {

/// A whole number of a field; less than 0 is 0.
template <typename Number>
std::uint32_t readNumber(const std::uint8_t* bytes)
{
  Number number{};
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<std::uint32_t>(std::max(number, Number{0}));
}

using ReadNumber = std::uint32_t (*)(const std::uint8_t*);

ReadNumber readerOf(const pcl::PCLPointField& field)
{
  switch (field.count == 1 ? field.datatype : 0) {
  case pcl::PCLPointField::INT8:
    return readNumber<std::int8_t>;
  case pcl::PCLPointField::UINT8:
    return readNumber<std::uint8_t>;
  case pcl::PCLPointField::INT16:
    return readNumber<std::int16_t>;
  case pcl::PCLPointField::UINT16:
    return readNumber<std::uint16_t>;
  case pcl::PCLPointField::INT32:
    return readNumber<std::int32_t>;
  case pcl::PCLPointField::UINT32:
    return readNumber<std::uint32_t>;
  default:
    return nullptr;
  }
}

} // namespace

std::vector<std::uint32_t> labels(const CloudFile& file)
{
  const auto* field = findField(file.cloud, LABEL);
  const ReadNumber read = field == nullptr ? nullptr : readerOf(*field);
  if (read == nullptr)
    return {};
  std::vector<std::uint32_t> result(pointCount(file.cloud));
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = read(&file.cloud.data[i * file.cloud.point_step + field->offset]);
  return result;
}

namespace {

/// The cloud with a last field of 4 bytes, value(i) for the i-th point.
template <typename Value>
CloudFile withField(const CloudFile& file, const std::string& name,
                    std::uint8_t datatype, const Value& value_of)
{
  const pcl::PCLPointCloud2& from = file.cloud;
  CloudFile result = {{}, file.origin, file.orientation, file.format};
  pcl::PCLPointCloud2& to = result.cloud;
  to.header = from.header;
  to.width = from.width;
  to.height = from.height;
  to.is_bigendian = from.is_bigendian;
  to.is_dense = from.is_dense;

  std::vector<pcl::PCLPointField> kept;
  std::uint32_t offset = 0;
  const auto place = [&](pcl::PCLPointField field) {
    field.offset = offset;
    offset += static_cast<std::uint32_t>(sizeOf(field));
    to.fields.push_back(field);
  };
  for (const auto& field : from.fields)
    if (field.name != name && field.name != "_") {
      kept.push_back(field);
      place(field);
    }
  pcl::PCLPointField last;
  last.name = name;
  last.datatype = datatype;
  last.count = 1;
  place(last);

  to.point_step = offset;
  to.row_step = offset * to.width;
  to.data.resize(pointCount(to) * to.point_step);
  for (std::size_t i = 0; i < pointCount(to); ++i) {
    const std::uint8_t* source = &from.data[i * from.point_step];
    std::uint8_t* target = &to.data[i * to.point_step];
    for (std::size_t k = 0; k < kept.size(); ++k)
      std::memcpy(target + to.fields[k].offset, source + kept[k].offset,
                  sizeOf(kept[k]));
    const auto value = value_of(i);
    std::memcpy(target + to.fields.back().offset, &value, sizeof value);
  }
  return result;
}

} // namespace

CloudFile withLabels(const CloudFile& file, const pcl::PointCloud<pcl::Label>& labels)
{
  return withField(file, LABEL, pcl::PCLPointField::UINT32,
                   [&](std::size_t i) -> std::uint32_t { return labels[i].label; });
}

CloudFile withConfidence(const CloudFile& file, const std::vector<float>& confidence)
{
  return withField(file, "confidence", pcl::PCLPointField::FLOAT32,
                   [&](std::size_t i) { return confidence[i]; });
}

} // namespace pcl_mrf_planes::io
