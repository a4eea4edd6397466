// SPDX-License-Identifier: BSD-3-Clause
// The cloud that the app writes: fields, pose, labels, encodings.
#include "cli_test.h"
#include "two_planes.h"

#include <pcl/io/pcd_io.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <regex>

namespace pcl_mrf_planes::test {

namespace {

struct Read {
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
};

Read readCloud(const std::string& path)
{
  Read result;
  int version = 0;
  pcl::PCDReader reader;
  EXPECT_GE(reader.read(path, result.cloud, result.origin, result.orientation, version),
            0)
      << "PCL cannot read what the app wrote";
  return result;
}

/// The same bytes, or two floats that are both NaN.
bool sameNumber(const pcl::PCLPointField& field, const std::uint8_t* a,
                const std::uint8_t* b, std::size_t size)
{
  if (std::memcmp(a, b, size) == 0)
    return true;
  float x = 0.0f;
  float y = 0.0f;
  if (field.datatype != pcl::PCLPointField::FLOAT32)
    return false;
  std::memcpy(&x, a, sizeof x);
  std::memcpy(&y, b, sizeof y);
  return std::isnan(x) && std::isnan(y);
}

void expectSameFields(const pcl::PCLPointCloud2& in, const pcl::PCLPointCloud2& out)
{
  for (const auto& field : in.fields) {
    if (field.name == "label")
      continue;
    const auto* there = findField(out, field.name);
    ASSERT_NE(there, nullptr) << "field " << field.name << " was lost";
    EXPECT_EQ(there->count, field.count) << field.name;
    const std::size_t size =
        static_cast<std::size_t>(pcl::getFieldSize(field.datatype)) * field.count;
    std::size_t different = 0;
    for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i)
      different += sameNumber(field, &in.data[i * in.point_step + field.offset],
                              &out.data[i * out.point_step + there->offset], size)
                       ? 0
                       : 1;
    EXPECT_EQ(different, 0u) << "values of field " << field.name << " changed";
  }
}

void expectLabels(const pcl::PCLPointCloud2& out)
{
  const auto* field = findField(out, "label");
  ASSERT_NE(field, nullptr);
  EXPECT_EQ(field->datatype, pcl::PCLPointField::UINT32);
  EXPECT_EQ(field->count, 1u);
  std::size_t right = 0;
  std::size_t valid = 0;
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i) {
    const auto label = getField<std::uint32_t>(out, i, "label");
    if (!TwoPlanes::valid(i)) {
      EXPECT_EQ(label, 0u) << "invalid point " << i << " has a label";
      continue;
    }
    ++valid;
    right += label == TwoPlanes::label(i) ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(right), 0.97 * static_cast<double>(valid))
      << "the wall is label 1, the floor 2";
}

std::string formatOf(const std::string& content)
{
  const auto start = content.find("DATA ") + 5;
  return content.substr(start, content.find('\n', start) - start);
}

} // namespace

class CloudOutput : public CliTest {};
class CloudFormats : public CloudOutput,
                     public ::testing::WithParamInterface<const char*> {};

TEST_P(CloudFormats, KeepsFieldsPoseAndEncodingAndAddsLabels)
{
  const TwoPlanes scene;
  scene.write(path("in.pcd"), GetParam());
  const Read in = readCloud(path("in.pcd"));
  const Outcome outcome = segment({path("in.pcd"), path("out.pcd")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "a run that succeeds is silent on stderr";
  EXPECT_EQ(formatOf(read("out.pcd")), GetParam());

  const Read out = readCloud(path("out.pcd"));
  EXPECT_EQ(out.cloud.width, in.cloud.width);
  EXPECT_EQ(out.cloud.height, in.cloud.height);
  EXPECT_EQ(out.cloud.fields.size(), in.cloud.fields.size())
      << "the old label is replaced, not kept beside the new one";
  EXPECT_EQ(out.origin, in.origin);
  EXPECT_EQ(out.orientation.coeffs(), in.orientation.coeffs());
  expectSameFields(in.cloud, out.cloud);
  expectLabels(out.cloud);
  EXPECT_EQ(files(), (std::set<std::string>{"in.pcd", "out.pcd"}))
      << "temporary files were left";
}

TEST_P(CloudFormats, IsWrittenInTheFormatAskedFor)
{
  const TwoPlanes scene;
  scene.write(path("in.pcd"), "binary");
  const Read in = readCloud(path("in.pcd"));
  const Outcome outcome =
      segment({path("in.pcd"), path("out.pcd"), "--format", GetParam()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(formatOf(read("out.pcd")), GetParam());
  const Read out = readCloud(path("out.pcd"));
  expectSameFields(in.cloud, out.cloud);
  expectLabels(out.cloud);
}

INSTANTIATE_TEST_SUITE_P(Encodings, CloudFormats,
                         ::testing::Values("ascii", "binary", "binary_compressed"),
                         [](const auto& encoding) {
                           return std::string(encoding.param);
                         });

TEST_F(CloudOutput, KeepsAPoseThatNeedsAllDigits)
{
  TwoPlanes scene;
  scene.write(path("six_digits.pcd"), "binary_compressed");
  std::string content = read("six_digits.pcd");
  const auto start = content.find("VIEWPOINT");
  content.replace(
      start, content.find('\n', start) - start,
      "VIEWPOINT 1.2345678 -20.000002 3.5000002 0.979 0.0826 0.165 -0.0826");
  write("in.pcd", content);
  const Read in = readCloud(path("in.pcd"));
  for (const char* format : {"ascii", "binary", "binary_compressed"}) {
    const Outcome outcome =
        segment({path("in.pcd"), path("out.pcd"), "--format", format});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Read out = readCloud(path("out.pcd"));
    EXPECT_EQ(out.origin, in.origin) << format;
    EXPECT_EQ(out.orientation.coeffs(), in.orientation.coeffs()) << format;
    expectSameFields(in.cloud, out.cloud);
  }
}

TEST_F(CloudOutput, MayReplaceItsInput)
{
  const TwoPlanes scene;
  scene.write(path("cloud.pcd"), "binary_compressed");
  const Read in = readCloud(path("cloud.pcd"));
  const Outcome outcome = segment({path("cloud.pcd"), path("cloud.pcd")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Read out = readCloud(path("cloud.pcd"));
  expectSameFields(in.cloud, out.cloud);
  expectLabels(out.cloud);
  EXPECT_EQ(files(), std::set<std::string>{"cloud.pcd"});
}

TEST_F(CloudOutput, FollowsALink)
{
  const TwoPlanes scene;
  scene.write(path("in.pcd"), "binary");
  write("target.pcd", "old");
  std::filesystem::create_symlink("target.pcd", path("link.pcd"));
  ASSERT_EQ(segment({path("in.pcd"), path("link.pcd")}).status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.pcd")));
  expectLabels(readCloud(path("target.pcd")).cloud);
}

TEST_F(CloudOutput, KeepsThePermissionsOfAFileItReplaces)
{
  using std::filesystem::perms;
  TwoPlanes().write(path("in.pcd"), "binary");
  write("out.pcd", "old");
  const perms only_owner = perms::owner_read | perms::owner_write;
  std::filesystem::permissions(path("out.pcd"), only_owner);
  ASSERT_EQ(segment({path("in.pcd"), path("out.pcd")}).status, 0);
  EXPECT_EQ(std::filesystem::status(path("out.pcd")).permissions(), only_owner);
}

TEST_F(CloudOutput, CanGoToStandardOutput)
{
  TwoPlanes().write(path("in.pcd"), "binary");
  const Outcome outcome =
      segment({path("in.pcd"), "--quiet", "--models", "/dev/stdout"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("coefficients"), std::string::npos);
}

TEST_F(CloudOutput, TakesCoordinatesOfDoublePrecision)
{
  TwoPlanes scene;
  pcl::PCLPointCloud2 wide;
  for (const char* name : {"x", "y", "z"})
    addField(wide, name, pcl::PCLPointField::FLOAT64, 1, 8);
  wide.width = scene.cloud.width;
  wide.height = scene.cloud.height;
  wide.row_step = wide.width * wide.point_step;
  wide.data.resize(TwoPlanes::POINTS * wide.point_step);
  for (std::size_t i = 0; i < TwoPlanes::POINTS; ++i)
    for (const char* name : {"x", "y", "z"})
      setField(wide, i, name,
               static_cast<double>(getField<float>(scene.cloud, i, name)));
  scene.cloud = wide;
  scene.write(path("in.pcd"), "binary");
  const Outcome outcome = segment({path("in.pcd"), path("out.pcd")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expectLabels(readCloud(path("out.pcd")).cloud);
}

TEST_F(CloudOutput, HasTheSameBitsOnEveryRunAndForAnyThreads)
{
  const TwoPlanes scene;
  scene.write(path("in.pcd"), "binary");
  const std::vector<std::vector<std::string>> runs = {{},
                                                      {},
                                                      {"--threads", "1"},
                                                      {"--threads", "2"},
                                                      {"--threads", "3"},
                                                      {"--threads", "8"},
                                                      {"--threads", "0"},
                                                      {"--repeat", "2"}};
  std::string first;
  for (const auto& options : runs) {
    std::vector<std::string> arguments = {path("in.pcd"), path("out.pcd")};
    for (const char* file : {"overlay", "label-image", "ply", "models"}) {
      arguments.push_back(std::string("--") + file);
      arguments.push_back(path(file));
    }
    for (const char* more : {"--outlines", "--creases", "--confidence"})
      arguments.emplace_back(more);
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = segment(arguments);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::string bits;
    for (const char* file : {"out.pcd", "overlay", "label-image", "ply", "models"}) {
      ASSERT_NE(read(file), "") << file;
      bits += read(file);
    }
    // The one thing that may differ: how many threads were asked for.
    bits = std::regex_replace(bits, std::regex("\"threads\": \\d+"), "");
    if (first.empty())
      first = bits;
    EXPECT_TRUE(bits == first) << "the result differs between runs";
  }
}

} // namespace pcl_mrf_planes::test
