// SPDX-License-Identifier: BSD-3-Clause
// Data sets in the layouts in which they are published, written here on a small scale.
#include "io_files.h"
#include "matlab_array.h"

#include <hdf5.h>

#include <cmath>
#include <sstream>

namespace pcl_mrf_planes::test {

namespace {

constexpr int WIDTH = 64; // a tenth of the sensors'
constexpr int HEIGHT = 48;
constexpr io::ImageSize SIZE{WIDTH, HEIGHT};

std::vector<double> metres(const std::vector<std::uint16_t>& values, double scale)
{
  std::vector<double> result;
  for (const std::uint16_t value : values)
    result.push_back(value / scale);
  return result;
}

std::vector<std::string> namesOf(const io::FrameList& list)
{
  std::vector<std::string> names;
  for (const auto& frame : list.frames)
    names.push_back(frame.name);
  return names;
}

using Names = std::vector<std::string>;

} // namespace

class DataSets : public IoTest {
protected:
  const std::vector<std::uint16_t> values_ = slantedWall(WIDTH, HEIGHT);

  void writeDepth(const std::string& name) const
  {
    writePng16(path(name), values_, WIDTH, HEIGHT);
  }
  void writeColour(const std::string& name) const
  {
    writeColourPng(path(name), WIDTH, HEIGHT);
  }
  io::CameraModel fitted(const std::string& preset) const
  {
    return io::fittedTo(io::cameraPreset(preset), SIZE);
  }
};

TEST_F(DataSets, TumListsAreAssociatedByTime)
{
  const std::string folder = "rgbd_dataset_freiburg2_desk/";
  write(folder + "depth.txt", "# depth maps\n1.031 depth/1.031.png\n"
                              "2.000 depth/2.000.png\n");
  write(folder + "rgb.txt",
        "# color images\n1.020 rgb/1.020.png\n1.500 rgb/1.500.png\n");
  writeDepth(folder + "depth/1.031.png");
  writeDepth(folder + "depth/2.000.png");
  writeColour(folder + "rgb/1.020.png");
  const io::FrameList frames = list("rgbd_dataset_freiburg2_desk");
  EXPECT_EQ(namesOf(frames), (Names{"depth/1.031", "depth/2.000"}));
  EXPECT_EQ(frames.frames[0].reader, "tum");
  const io::Frame frame = frames.frames[0].read();
  expectSeenBy(frame, fitted("tum-fr2"), metres(values_, 5000.0));
  EXPECT_FALSE(frame.colours.empty()) << "11 ms apart";
  EXPECT_TRUE(frames.frames[1].read().colours.empty()) << "500 ms apart";
}

TEST_F(DataSets, TumWithAssociationsInEitherOrder)
{
  write("fr/associations.txt", "1.02 rgb/a.png 1.03 depth/b.png\n");
  writeDepth("fr/depth/b.png");
  writeColour("fr/rgb/a.png");
  const io::FrameList frames = list("fr");
  ASSERT_EQ(frames.frames.size(), 1u);
  EXPECT_EQ(frames.frames[0].reader, "tum");
  const io::Frame frame = frames.frames[0].read();
  expectSeenBy(frame, fitted("tum"), metres(values_, 5000.0));
  EXPECT_FALSE(frame.colours.empty());
}

TEST_F(DataSets, IclNuimAsTumCompatiblePngs)
{
  write("traj0/associations.txt",
        "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n");
  for (const char* number : {"0", "1"}) {
    writeDepth(std::string("traj0/depth/") + number + ".png");
    writeColour(std::string("traj0/rgb/") + number + ".png");
  }
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames), (Names{"traj0/depth/0", "traj0/depth/1"}));
  EXPECT_EQ(frames.frames[0].reader, "icl-nuim");
  expectSeenBy(frames.frames[0].read(), fitted("icl-nuim"), metres(values_, 5000.0));
}

TEST_F(DataSets, IclNuimAsTextHasDistancesAlongTheRays)
{
  std::ostringstream text;
  const io::CameraModel camera = io::cameraPreset("icl-nuim");
  for (int row = 0; row < 480; ++row)
    for (int column = 0; column < 640; ++column) {
      const double x = (column - 319.5) / 481.2, y = (row - 239.5) / 480.0;
      text << 2.5 * std::sqrt(1.0 + x * x + y * y) << ' ';
    }
  text << '\n';
  write("scene_00_0000.depth", text.str());
  const io::Frame frame = frameOf("scene_00_0000.depth");
  for (std::size_t i = 0; i < 640 * 480; i += 101)
    ASSERT_NEAR(pointOf(frame.file, i).z(), 2.5f, 1e-4f) << "a wall at right angles";
  EXPECT_EQ(list().frames[0].reader, "icl-nuim-text");
  write("scene_00_0001.depth", text.str().substr(0, 1000));
  expectError("scene_00_0001.depth", {"640 x 480"});
}

TEST_F(DataSets, SevenScenes)
{
  auto values = values_;
  values[5] = 65535;
  writePng16(path("kitchen/seq-01/frame-000007.depth.png"), values, WIDTH, HEIGHT);
  writeColour("kitchen/seq-01/frame-000007.color.png");
  write("kitchen/seq-01/frame-000007.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames), (Names{"kitchen/seq-01/frame-000007"}));
  EXPECT_EQ(frames.frames[0].reader, "7scenes");
  const io::Frame frame = frames.frames[0].read();
  auto depth = metres(values, 1000.0);
  depth[5] = 0.0; // not measured
  expectSeenBy(frame, fitted("7scenes"), depth);
  EXPECT_FALSE(frame.colours.empty());
  EXPECT_EQ(frames.passed_over.size(), 2u) << "colour and pose";
}

TEST_F(DataSets, RedwoodScenesAndScans)
{
  writeDepth("livingroom/depth/00003.png");
  writeColour("livingroom/image/00003.png");
  writeDepth("scan/depth/0000002-000000033369.png");
  writeColour("scan/rgb/0000002-000000040000.png");
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames),
            (Names{"livingroom/depth/00003", "scan/depth/0000002-000000033369"}));
  for (const auto& source : frames.frames) {
    EXPECT_EQ(source.reader, "redwood");
    const io::Frame frame = source.read();
    expectSeenBy(frame, fitted("redwood"), metres(values_, 1000.0));
    EXPECT_FALSE(frame.colours.empty()) << source.name;
  }
}

TEST_F(DataSets, RawNyuDumpsAreSwappedDisparities)
{
  std::vector<std::uint16_t> disparities;
  std::vector<double> depth;
  for (int i = 0; i < WIDTH * HEIGHT; ++i) {
    disparities.push_back(
        static_cast<std::uint16_t>(i % 11 == 0 ? 2047 : 500 + i % 499));
    depth.push_back(i % 11 == 0 ? 0.0 : 351.3 / (1092.5 - disparities.back()));
  }
  write("cafe/d-1315166703.129542-2466408789.pgm",
        pgm16(disparities, WIDTH, HEIGHT, false));
  write("cafe/r-1315166703.1-2466408789.ppm", "P6 1 1 255\n123");
  write("cafe/a-1315166703.1-2466408789.dump", "acceleration");
  const io::FrameList frames = list();
  ASSERT_EQ(frames.frames.size(), 1u);
  expectSeenBy(frames.frames[0].read(), fitted("nyu-raw"), depth);
}

TEST_F(DataSets, PlainPgmIsBigEndianAndNeedsACamera)
{
  write("a.pgm", pgm16(values_, WIDTH, HEIGHT, true));
  expectError("a.pgm", {"without a camera", "--camera"});
  io::ReadOptions options;
  options.camera = io::cameraPreset("kinect1");
  expectSeenBy(frameOf("a.pgm", options), fitted("kinect1"), metres(values_, 1000.0));
}

namespace {

/// nyu_depth_v2_labeled.mat with two frames: depth k + 1 + (column + row) / 1000.
void writeLabeled(const std::string& path)
{
  const hid_t properties = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_userblock(properties, 512); // "MATLAB 7.3 MAT-file" stands there
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, properties, H5P_DEFAULT);
  std::vector<float> raw, filled;
  std::vector<std::uint8_t> images;
  for (int k = 0; k < 2; ++k) {
    for (int x = 0; x < WIDTH; ++x)
      for (int y = 0; y < HEIGHT; ++y) {
        filled.push_back(static_cast<float>(k + 1) +
                         static_cast<float>(x + y) / 1000.0f);
        raw.push_back((x + y) % 5 == 0 ? 0.0f : filled.back());
      }
    for (int c = 0; c < 3; ++c)
      for (int x = 0; x < WIDTH; ++x)
        for (int y = 0; y < HEIGHT; ++y)
          images.push_back(static_cast<std::uint8_t>(c == 0 ? x : c == 1 ? y : 33 + k));
  }
  writeArray(file, "rawDepths", H5T_NATIVE_FLOAT, {2, WIDTH, HEIGHT}, raw.data());
  writeArray(file, "depths", H5T_NATIVE_FLOAT, {2, WIDTH, HEIGHT}, filled.data());
  writeArray(file, "images", H5T_NATIVE_UINT8, {2, 3, WIDTH, HEIGHT}, images.data());
  H5Fclose(file);
  H5Pclose(properties);
}

std::vector<double> labeledDepth(int k, bool filled)
{
  std::vector<double> depth;
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x)
      depth.push_back(!filled && (x + y) % 5 == 0 ? 0.0 : k + 1 + (x + y) / 1000.0);
  return depth;
}

} // namespace

TEST_F(DataSets, LabeledNyuIsTransposedMatlab)
{
  writeLabeled(path("nyu_depth_v2_labeled.mat"));
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames),
            (Names{"nyu_depth_v2_labeled/0001", "nyu_depth_v2_labeled/0002"}));
  for (std::size_t k = 0; k < 2; ++k) {
    const io::Frame frame = frames.frames[k].read();
    expectSeenBy(frame, fitted("nyu"), labeledDepth(static_cast<int>(k), false));
    ASSERT_EQ(frame.colours.size(), SIZE.points());
    EXPECT_EQ(frame.colours[WIDTH * 7 + 11],
              (io::Colour{11, 7, static_cast<std::uint8_t>(33 + k)}));
  }
  io::ReadOptions options;
  options.filled_depth = true;
  expectSeenBy(list("", options).frames[1].read(), fitted("nyu"),
               labeledDepth(1, true));
}

TEST_F(DataSets, DamagedHdf5GivesAMessage)
{
  writeLabeled(path("whole.mat"));
  const std::string whole = read("whole.mat");
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 40) {
    write("cut.mat", whole.substr(0, size));
    const io::FrameList frames = list("cut.mat");
    for (const auto& frame : frames.frames)
      EXPECT_THROW(frame.read(), std::runtime_error) << "cut to " << size;
  }
  const hid_t other =
      H5Fcreate(path("other.mat").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const float one = 1.0f;
  writeArray(other, "depths", H5T_NATIVE_FLOAT, {1, 1}, &one);
  H5Fclose(other);
  expectError("other.mat", {"dimensions"});
}

class SegComp : public IoTest {
protected:
  static constexpr int SIDE = 512;

  static std::string pgm8(const std::vector<std::uint8_t>& values)
  {
    return "P5\n512 512\n255\n" + std::string(values.begin(), values.end());
  }

  static std::string bigEndian(std::uint32_t value)
  {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>(value >> shift);
    return bytes;
  }
};

TEST_F(SegComp, AbwIsAPinholeWithTwoCalibrations)
{
  std::vector<std::uint8_t> values(SIDE * SIDE, 128);
  values[0] = 0; // shadow
  std::vector<std::uint8_t> truth(SIDE * SIDE, 12);
  truth[1] = 3;
  write("abw.test.3.range", pgm8(values));
  write("abw.test.19.range", bigEndian(0x59a66a95) + bigEndian(SIDE) + bigEndian(SIDE) +
                                 bigEndian(8) + bigEndian(SIDE * SIDE) + bigEndian(1) +
                                 bigEndian(0) + bigEndian(0) +
                                 std::string(values.begin(), values.end()));
  write("abw.test.3.range.gt-seg", pgm8(truth));
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames), (Names{"abw.test.19", "abw.test.3"}));
  const io::Frame first = frames.frames[0].read(), second = frames.frames[1].read();
  EXPECT_TRUE(std::isnan(pointOf(first.file, 0).z())) << "0 is shadow";
  EXPECT_NEAR(pointOf(first.file, 1).z(), (128 / 0.773545 + 785.410786) / 1000, 1e-6);
  EXPECT_NEAR(pointOf(second.file, 1).z(), (128 / 0.791686 + 771.016866) / 1000, 1e-6);
  const Eigen::Vector3f p = pointOf(second.file, 100 * SIDE + 300);
  EXPECT_NEAR(p.x() / p.z(), 45 / 1586.072821, 1e-6) << "to the right";
  EXPECT_NEAR(p.y() / p.z(), -155 / 1586.072821 / 1.4508, 1e-6) << "up";
  EXPECT_TRUE(first.truth.empty());
  ASSERT_EQ(second.truth.size(), values.size());
  EXPECT_EQ(second.truth[0], 12);
  EXPECT_EQ(second.truth[1], 0) << "below 10 is no plane";
}

TEST_F(SegComp, PerceptronIsTwoMirrors)
{
  std::string bytes = "Rows: 512\nColumns: 512\na b c\na b c\na b c\na b c\n"
                      "a b c d\na b c d\na b c\na b c d e\n\n";
  for (int i = 0; i < SIDE * SIDE; ++i)
    bytes += bigEndian(0xabc00000u | (i == 0 ? 0u : 1000u)); // reflectance on top
  write("perc.test.3", bytes);
  std::vector<std::uint8_t> truth(SIDE * SIDE, 20);
  write("perc.test.3.gt-seg", pgm8(truth));
  const io::FrameList frames = list();
  EXPECT_EQ(namesOf(frames), (Names{"perc.test.3"}));
  const io::Frame frame = frames.frames[0].read();
  EXPECT_TRUE(std::isnan(pointOf(frame.file, 0).z()));
  // In the middle the beam is not turned: its length is (range + standoff) 0.20236 cm.
  const Eigen::Vector3f middle = pointOf(frame.file, 255 * SIDE + 255);
  EXPECT_NEAR(middle.z(), (1000 + 830.3) * 0.0020236, 1e-3);
  EXPECT_LT(middle.head<2>().norm(), 5e-3f);
  const Eigen::Vector3f left = pointOf(frame.file, 255 * SIDE);
  const Eigen::Vector3f right = pointOf(frame.file, 255 * SIDE + SIDE - 1);
  const double wide = std::atan2(right.x(), right.z()) - std::atan2(left.x(), left.z());
  // The mirrors move the start of the beam by centimetres: a degree at this distance.
  EXPECT_NEAR(wide * 180.0 / M_PI, 51.65 * 511 / 512, 1.0) << "left is left";
  const Eigen::Vector3f top = pointOf(frame.file, 255);
  const Eigen::Vector3f bottom = pointOf(frame.file, (SIDE - 1) * SIDE + 255);
  const double high = std::atan2(bottom.y(), bottom.z()) - std::atan2(top.y(), top.z());
  EXPECT_NEAR(high * 180.0 / M_PI, 36.73 * 511 / 512, 1.0) << "up is up";
  EXPECT_EQ(frame.truth, std::vector<std::uint16_t>(SIDE * SIDE, 20));
  write("perc.test.4", bytes.substr(0, 100000));
  expectError("perc.test.4", {"truncated"});
}

} // namespace pcl_mrf_planes::test
