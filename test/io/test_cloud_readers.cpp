// SPDX-License-Identifier: BSD-3-Clause
// Clouds: PLY as PCL and scanners write it, PCL's PCLZF pairs, SynPEB's PCDs.
#include "io_files.h"

#include <pcl/io/lzf_image_io.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>

namespace pcl_mrf_planes::test {

namespace {

constexpr int WIDTH = 12;
constexpr int HEIGHT = 9;

/// An organized cloud with colours; every fifth point is invalid.
pcl::PointCloud<pcl::PointXYZRGB> coloured()
{
  pcl::PointCloud<pcl::PointXYZRGB> cloud(WIDTH, HEIGHT);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    auto& p = cloud[i];
    p.x = 0.1f * static_cast<float>(i % WIDTH);
    p.y = 0.1f * static_cast<float>(i / WIDTH);
    p.z = i % 5 == 0 ? NAN : 2.0f;
    if (i % 5 == 0)
      p.x = p.y = NAN;
    p.r = static_cast<std::uint8_t>(i);
  }
  cloud.is_dense = false;
  return cloud;
}

void expectSame(const io::Frame& frame, const pcl::PointCloud<pcl::PointXYZRGB>& cloud)
{
  ASSERT_EQ(frame.file.cloud.width, cloud.width);
  ASSERT_EQ(frame.file.cloud.height, cloud.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = pointOf(frame.file, i);
    if (std::isnan(cloud[i].z)) {
      EXPECT_TRUE(std::isnan(p.z()));
    }
    else {
      EXPECT_LT((p - cloud[i].getVector3fMap()).norm(), 1e-5f) << i;
    }
  }
}

} // namespace

class PlyFiles : public IoTest {};

TEST_F(PlyFiles, OfPclAreOrganizedInEveryEncoding)
{
  const auto cloud = coloured();
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  pcl::PLYWriter writer;
  for (const bool binary : {false, true})
    for (const bool camera : {false, true}) {
      SCOPED_TRACE(std::string(binary ? "binary" : "ascii") +
                   (camera ? " camera" : ""));
      ASSERT_EQ(writer.write(path("a.ply"), blob, Eigen::Vector4f::Zero(),
                             Eigen::Quaternionf::Identity(), binary, camera),
                0);
      const io::Frame frame = frameOf("a.ply");
      expectSame(frame, cloud);
    }
}

TEST_F(PlyFiles, OfOthersByTheirNumbersOfRowsAndColumns)
{
  std::string points;
  for (int i = 0; i < 6; ++i)
    points += std::to_string(i) + " 0 2\n";
  const std::string body = "element vertex 6\nproperty float x\nproperty float y\n"
                           "property float z\nend_header\n" +
                           points;
  write("a.ply",
        "ply\nformat ascii 1.0\nobj_info num_cols 3\nobj_info num_rows 2\n" + body);
  const io::Frame frame = frameOf("a.ply");
  EXPECT_EQ(frame.file.cloud.width, 3u);
  EXPECT_EQ(pointOf(frame.file, 4), Eigen::Vector3f(4, 0, 2));

  write("b.ply", "ply\nformat ascii 1.0\n" + body);
  expectError("b.ply", {"is not organized", "--size", "num_cols"});
  io::ReadOptions options;
  options.size = {3, 2};
  EXPECT_EQ(frameOf("b.ply", options).file.cloud.height, 2u);
  options.size = {4, 2};
  expectError("b.ply", {"4 x 2", "--size"}, options);
}

TEST_F(PlyFiles, DamagedOnesGiveAMessage)
{
  const std::string header = "ply\nformat binary_little_endian 1.0\n"
                             "element vertex 4000000000\nproperty float x\n"
                             "property float y\nproperty float z\nend_header\n";
  write("huge.ply", header + "1234");
  expectError("huge.ply", {"truncated"});
  write("no_end.ply", "ply\nformat ascii 1.0\nelement vertex 6\n");
  expectError("no_end.ply", {"end_header"});
  // Found by fuzzing.
  write("bare.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 6\nend_header\n");
  expectError("bare.ply", {"damaged header", "without properties"});
  // Found by reading the code: no conversion of such a count is defined.
  write("beyond.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1e30\n"
                      "property float x\nend_header\n1234");
  expectError("beyond.ply", {"truncated"});
  write("type.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                    "property colour x\nend_header\n123456789");
  expectError("type.ply", {"unknown type"});
  write("claim.ply", "ply\nformat ascii 1.0\nobj_info num_cols 30000\n"
                     "obj_info num_rows 20000\nelement vertex 2\nproperty float x\n"
                     "property float y\nproperty float z\nend_header\n1 2 3\n1 2 3\n");
  expectError("claim.ply", {"num_cols"});
}

class PclzfFiles : public IoTest {
protected:
  void SetUp() override
  {
    IoTest::SetUp();
    pcl::io::CameraParameters camera{};
    camera.focal_length_x = 60.0;
    camera.focal_length_y = 61.0;
    camera.principal_point_x = 18.25;
    camera.principal_point_y = 11.5;
    pcl::io::LZFDepth16ImageWriter depth;
    ASSERT_TRUE(depth.write(reinterpret_cast<const char*>(values_.data()), W, H,
                            path("frame_1_depth.pclzf")));
    ASSERT_TRUE(depth.writeParameters(camera, path("frame_1.xml")));
    std::vector<char> rgb;
    for (int i = 0; i < W * H; ++i)
      for (const int channel : {i % W, i / W, 33})
        rgb.push_back(static_cast<char>(channel));
    pcl::io::LZFRGB24ImageWriter colour;
    ASSERT_TRUE(colour.write(rgb.data(), W, H, path("frame_1_rgb.pclzf")));
  }

  static constexpr int W = 37, H = 23;
  const std::vector<std::uint16_t> values_ = slantedWall(W, H);
};

TEST_F(PclzfFiles, APairIsOneFrameWithItsCameraAndColours)
{
  const io::FrameList frames = list();
  ASSERT_EQ(frames.frames.size(), 1u) << "the colours are no frame";
  EXPECT_EQ(frames.frames[0].name, "frame_1");
  const io::Frame frame = frames.frames[0].read();
  std::vector<double> depth;
  for (const std::uint16_t value : values_)
    depth.push_back(value / 1000.0);
  expectSeenBy(frame, io::parseCamera("60,61,18.25,11.5"), depth);
  ASSERT_EQ(frame.colours.size(), values_.size());
  EXPECT_EQ(frame.colours[3 * W + 5], (io::Colour{5, 3, 33}));
}

TEST_F(PclzfFiles, IsThePointsThatPclReads)
{
  pcl::io::LZFDepth16ImageReader reader;
  ASSERT_TRUE(reader.readParameters(path("frame_1.xml")));
  pcl::PointCloud<pcl::PointXYZ> expected;
  ASSERT_TRUE(reader.read(path("frame_1_depth.pclzf"), expected));
  const io::Frame frame = frameOf("frame_1_depth.pclzf");
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (std::isfinite(expected[i].z)) {
      EXPECT_LT((pointOf(frame.file, i) - expected[i].getVector3fMap()).norm(), 1e-5f);
    }
}

TEST_F(PclzfFiles, DamagedOnesGiveAMessage)
{
  const std::string whole = read("frame_1_depth.pclzf");
  for (std::size_t size = 5; size < whole.size(); size += 1 + size / 16) {
    write("cut_depth.pclzf", whole.substr(0, size));
    expectError("cut_depth.pclzf", {"truncated or damaged"});
  }
  for (std::size_t i = 5; i < 37; ++i) { // each byte of the header
    std::string other = whole;
    other[i] = static_cast<char>(other[i] ^ 0x55);
    write("x_depth.pclzf", other);
    EXPECT_THROW(frameOf("x_depth.pclzf", {}), std::runtime_error) << i;
  }
  expectError("frame_1_rgb.pclzf", {"rgb24", "depth16"});
}

class SynpebFiles : public IoTest {};

TEST_F(SynpebFiles, TheGroundTruthIsTheIntensity)
{
  pcl::PointCloud<pcl::PointXYZI> cloud(WIDTH, HEIGHT);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    cloud[i].x = 4.0f;
    cloud[i].y = static_cast<float>(i % WIDTH);
    cloud[i].z = static_cast<float>(i / WIDTH);
    cloud[i].intensity = i % 3 == 0 ? 7.0f : static_cast<float>(10 + i % 3);
  }
  pcl::io::savePCDFileASCII(path("test/var1/pc_01.pcd"), cloud);
  const io::FrameList frames = list();
  ASSERT_EQ(frames.frames.size(), 1u);
  EXPECT_EQ(frames.frames[0].name, "test/var1/pc_01");
  EXPECT_EQ(frames.frames[0].reader, "synpeb");
  const io::Frame frame = frames.frames[0].read();
  ASSERT_EQ(frame.truth.size(), cloud.size());
  EXPECT_EQ(frame.truth[0], 0) << "numbers below 10 are no planes";
  EXPECT_EQ(frame.truth[1], 11);

  cloud[5].intensity = 0.5f; // that of a real lidar
  pcl::io::savePCDFileASCII(path("test/var1/pc_01.pcd"), cloud);
  EXPECT_TRUE(list().frames[0].read().truth.empty());
}

} // namespace pcl_mrf_planes::test
