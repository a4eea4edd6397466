// SPDX-License-Identifier: BSD-3-Clause
#include "io_files.h"

#include <pcl/io/png_io.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

namespace pcl_mrf_planes::test {

namespace fs = std::filesystem;

void IoTest::SetUp()
{
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("pcl_mrf_planes_io_") + info->test_suite_name() + '_' +
                     info->name() + '_' + std::to_string(::getpid());
  for (char& c : name)
    c = c == '/' ? '_' : c;
  folder_ = fs::temp_directory_path() / name;
  fs::create_directories(folder_);
}

void IoTest::TearDown()
{
  fs::remove_all(folder_);
}

std::string IoTest::path(const std::string& name) const
{
  const fs::path file = folder_ / name;
  fs::create_directories(file.parent_path());
  return name.empty() ? folder_.string() : file.string();
}

void IoTest::write(const std::string& name, const std::string& bytes) const
{
  std::ofstream(path(name), std::ios::binary) << bytes;
}

std::string IoTest::read(const std::string& name) const
{
  std::ostringstream bytes;
  bytes << std::ifstream(path(name), std::ios::binary).rdbuf();
  return bytes.str();
}

io::FrameList IoTest::list(const std::string& name,
                           const io::ReadOptions& options) const
{
  return io::listFrames({path(name)}, options);
}

io::Frame IoTest::frameOf(const std::string& name, const io::ReadOptions& options) const
{
  const io::FrameList frames = list(name, options);
  EXPECT_EQ(frames.frames.size(), 1u);
  return frames.frames.at(0).read();
}

void IoTest::expectError(const std::string& name, const std::vector<std::string>& parts,
                         const io::ReadOptions& options) const
{
  try {
    frameOf(name, options);
    ADD_FAILURE() << name << " was read";
  }
  catch (const std::runtime_error& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "expected '" << part << "' in: " << error.what();
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
}

Eigen::Vector3f pointOf(const io::CloudFile& file, std::size_t i)
{
  Eigen::Vector3f p;
  for (int k = 0; k < 3; ++k)
    std::memcpy(&p[k],
                &file.cloud.data[i * file.cloud.point_step +
                                 file.cloud.fields[static_cast<std::size_t>(k)].offset],
                sizeof(float));
  return p;
}

std::vector<std::uint16_t> slantedWall(int width, int height)
{
  std::vector<std::uint16_t> values;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      values.push_back(static_cast<std::uint16_t>(
          (row * width + column) % 7 == 0 ? 0 : 1000 + 2 * column + 3 * row));
  return values;
}

void writePng16(const std::string& path, const std::vector<std::uint16_t>& values,
                int width, int height)
{
  pcl::io::saveShortPNGFile(path, const_cast<std::uint16_t*>(values.data()), width,
                            height, 1);
}

void writeColourPng(const std::string& path, int width, int height)
{
  std::vector<unsigned char> bytes;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      for (const int channel : {column, row, 33})
        bytes.push_back(static_cast<unsigned char>(channel));
  pcl::io::saveRgbPNGFile(path, bytes.data(), width, height);
}

std::string pgm16(const std::vector<std::uint16_t>& values, int width, int height,
                  bool big_endian)
{
  std::string bytes = "P5\n# a comment\n" + std::to_string(width) + " " +
                      std::to_string(height) + "\n65535\n";
  for (const std::uint16_t value : values) {
    const char high = static_cast<char>(value >> 8), low = static_cast<char>(value);
    bytes += big_endian ? high : low;
    bytes += big_endian ? low : high;
  }
  return bytes;
}

void expectSeenBy(const io::Frame& frame, const io::CameraModel& camera,
                  const std::vector<double>& depth)
{
  const std::size_t width = frame.file.cloud.width;
  ASSERT_EQ(width * frame.file.cloud.height, depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const Eigen::Vector3f p = pointOf(frame.file, i);
    if (!(depth[i] > 0.0)) {
      EXPECT_TRUE(std::isnan(p.z())) << "point " << i << " was not measured";
      continue;
    }
    const double tolerance = 1e-6 * depth[i];
    ASSERT_NEAR(p.z(), depth[i], tolerance) << "depth of point " << i;
    ASSERT_NEAR(camera.fx * p.x() / p.z() + camera.cx, static_cast<double>(i % width),
                1e-3);
    ASSERT_NEAR(camera.fy * p.y() / p.z() + camera.cy, static_cast<double>(i / width),
                1e-3);
  }
}

} // namespace pcl_mrf_planes::test
