// SPDX-License-Identifier: BSD-3-Clause
// Fields of a cloud beside its coordinates.
#include <pcl_mrf_planes/io/cloud_fields.h>

#include <gtest/gtest.h>

#include <cstring>

namespace pcl_mrf_planes::test {

namespace {

/// Three points with a byte of something else before the field.
template <typename Number>
io::CloudFile withField(const std::string& name, std::uint8_t datatype,
                        const std::vector<Number>& values)
{
  io::CloudFile file;
  file.cloud.width = static_cast<std::uint32_t>(values.size());
  file.cloud.height = 1;
  file.cloud.point_step = 1 + sizeof(Number);
  pcl::PCLPointField field;
  field.name = name;
  field.offset = 1;
  field.datatype = datatype;
  field.count = 1;
  file.cloud.fields.push_back(field);
  file.cloud.data.assign(values.size() * file.cloud.point_step, 77);
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(&file.cloud.data[i * file.cloud.point_step + 1], &values[i],
                sizeof(Number));
  return file;
}

template <typename Number>
void expectLabels(std::uint8_t datatype, const std::vector<Number>& values,
                  const std::vector<std::uint32_t>& expected)
{
  EXPECT_EQ(io::labels(withField("label", datatype, values)), expected)
      << "type " << int{datatype};
}

TEST(Labels, AreReadFromWholeNumbersOfAnySize)
{
  using Field = pcl::PCLPointField;
  expectLabels<std::uint8_t>(Field::UINT8, {0, 1, 255}, {0, 1, 255});
  expectLabels<std::uint16_t>(Field::UINT16, {0, 300, 65535}, {0, 300, 65535});
  expectLabels<std::uint32_t>(Field::UINT32, {7, 0, 4000000000u}, {7, 0, 4000000000u});
  expectLabels<std::int8_t>(Field::INT8, {-1, 5, 127}, {0, 5, 127});
  expectLabels<std::int16_t>(Field::INT16, {-300, 300, 0}, {0, 300, 0});
  expectLabels<std::int32_t>(Field::INT32, {-1, 70000, 2}, {0, 70000, 2});
}

TEST(Labels, AreNoneWithoutAFieldOfWholeNumbers)
{
  using Field = pcl::PCLPointField;
  EXPECT_TRUE(io::labels(withField<float>("label", Field::FLOAT32, {1.0f})).empty());
  EXPECT_TRUE(
      io::labels(withField<std::uint32_t>("object", Field::UINT32, {1})).empty());
  io::CloudFile pairs = withField<std::uint16_t>("label", Field::UINT16, {1, 2});
  pairs.cloud.fields[0].count = 2;
  EXPECT_TRUE(io::labels(pairs).empty()) << "which of two numbers is the label?";
}

} // namespace

} // namespace pcl_mrf_planes::test
