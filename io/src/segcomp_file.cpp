// SPDX-License-Identifier: BSD-3-Clause
#include "file_text.h"
#include "readers.h"

#include <pcl_mrf_planes/io/image_file.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace pcl_mrf_planes::io {

namespace fs = std::filesystem;

// The images of Hoover et al., "An Experimental Comparison of Range Image Segmentation
// Algorithms" (PAMI 1996), and the models of their scanners in its range-to-coords.c.
namespace {

constexpr float NOT_MEASURED = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint16_t FIRST_PLANE =
    10; // shadow, noise and border have smaller numbers
constexpr double PI = 3.14159265358979323846;

Image16 readGray8(const std::string& path)
{
  if (readStart(path, 2) != "P5")
    return readSunRaster(path);
  int maximum = 0;
  Image16 image = readPgm(path, ByteOrder::BIG_ENDIAN_FIRST, &maximum);
  if (maximum > 255)
    throw std::runtime_error("has 16 bits a point; the images of ABW have 8");
  return image;
}

/// The planes of FILE.gt-seg; empty without that file.
std::vector<std::uint16_t> truthBeside(const std::string& path, ImageSize size)
{
  const std::string file = path + ".gt-seg";
  std::error_code error;
  if (!fs::is_regular_file(file, error))
    return {};
  Image16 image;
  try {
    image = readGray8(file);
  }
  catch (const std::runtime_error& problem) {
    throw std::runtime_error("has ground truth that cannot be read: '" + file + "' " +
                             problem.what());
  }
  if (image.width != size.width || image.height != size.height)
    throw std::runtime_error("has ground truth of another size; check '" + file + "'");
  for (std::uint16_t& label : image.pixels)
    label = label < FIRST_PLANE ? std::uint16_t{0} : label;
  return std::move(image.pixels);
}

/// The seven test images of the first calibration; all others have the second.
bool hasFirstCalibration(const std::string& path)
{
  const std::string name = fs::path(path).filename().string();
  for (const char* number : {"0", "19", "21", "25", "27", "28", "29"})
    if (name.find("abw.test." + std::string(number) + ".") != std::string::npos ||
        name == "abw.test." + std::string(number))
      return true;
  return false;
}

/// A pinhole camera with rows that are C times as near to each other as columns;
/// z = value / SCAL + OFFSET millimetres.
CameraModel abwCamera(const std::string& path, double& scale, double& offset)
{
  const bool first = hasFirstCalibration(path);
  CameraModel camera;
  offset = first ? 785.410786 : 771.016866;
  scale = first ? 0.773545 : 0.791686;
  camera.fx = first ? 1610.981722 : 1586.072821;
  camera.fy = camera.fx * 1.4508;
  camera.cx = camera.cy = 255.0;
  camera.source =
      first ? "SegComp ABW, first calibration" : "SegComp ABW, second calibration";
  return camera;
}

/// Point of the laser scanner, centimetres: x left, y up, z forward. Two mirrors turn
/// the beam by alpha (left) and beta (up); dx, dy, dz is where it leaves the second.
/// The unit is that of the mirrors' distances; 4096 range values are 8.3 m.
Eigen::Vector3d perceptronPoint(int row, int column, double range)
{
  constexpr double H1 = 3.0, H2 = 5.5; // distances between beam and mirrors
  constexpr double FIELD_ACROSS = 51.65 * PI / 180.0, FIELD_UP = 36.73 * PI / 180.0;
  constexpr double STANDOFF = 830.3, DELTA = 0.20236; // range values; cm per value
  const double alpha = FIELD_ACROSS * (255.5 - column) / 512.0;
  const double beta = FIELD_UP * (255.5 - row) / 512.0;
  const double dz = -H1 * (1.0 - std::cos(alpha)); // mirrors at 45 degrees
  const double dy = dz * std::tan(PI / 4.0 + 0.5 * beta);
  const double dx = (H2 + dy) * std::tan(alpha);
  const double to_first = (dz - H2) / DELTA;
  const double to_second = std::sqrt(dx * dx + (H2 + dy) * (H2 + dy)) / DELTA;
  const double rest = (range + STANDOFF - (to_first + to_second)) * DELTA;
  return {dx + rest * std::sin(alpha), dy + rest * std::cos(alpha) * std::sin(beta),
          dz + rest * std::cos(alpha) * std::cos(beta)};
}

constexpr int PERCEPTRON_SIZE = 512;
constexpr int PERCEPTRON_HEADER_LINES = 10;
constexpr std::uint32_t RANGE_BITS = 4095; // of a word; reflectance has others

/// Bytes to the first point: ten lines and an empty one.
std::size_t perceptronStart(const std::string& bytes)
{
  std::size_t at = 0;
  for (int line = 0; line <= PERCEPTRON_HEADER_LINES; ++line) {
    at = bytes.find('\n', at);
    if (at == std::string::npos)
      throw std::runtime_error("has no header of ten lines as the PERCEPTRON images of "
                               "SegComp; copy it again");
    ++at;
  }
  return at;
}

std::uint32_t rangeAt(const std::string& bytes, std::size_t at)
{
  std::uint32_t word = 0;
  for (std::size_t k = 0; k < 4; ++k)
    word = (word << 8) | static_cast<std::uint8_t>(bytes[at + k]);
  return word & RANGE_BITS;
}

} // namespace

Frame readAbw(const std::string& path)
{
  const Image16 values = readGray8(path);
  double scale = 1.0, offset = 0.0;
  Frame frame;
  frame.camera = abwCamera(path, scale, offset);
  DepthMap depth(values.width, values.height, NOT_MEASURED);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i)
    if (values.pixels[i] != 0)
      depth.pixels[i] = static_cast<float>(1e-3 * (values.pixels[i] / scale + offset));
  frame.file = cloudFromDepth(depth, *frame.camera);
  frame.truth = truthBeside(path, {values.width, values.height});
  return frame;
}

Frame readPerceptron(const std::string& path)
{
  const std::string bytes = readBytes(path);
  const std::size_t start = perceptronStart(bytes);
  constexpr std::size_t POINTS =
      static_cast<std::size_t>(PERCEPTRON_SIZE) * PERCEPTRON_SIZE;
  if (bytes.size() - start < 4 * POINTS)
    throw std::runtime_error("is truncated: 512 x 512 words of range are due; copy it "
                             "again");
  CameraModel any; // the cloud is laid out by it, its points are replaced
  any.fx = any.fy = 1.0;
  Frame frame;
  frame.file =
      cloudFromDepth(DepthMap(PERCEPTRON_SIZE, PERCEPTRON_SIZE, NOT_MEASURED), any);
  for (std::size_t i = 0; i < POINTS; ++i) {
    const std::uint32_t range = rangeAt(bytes, start + 4 * i);
    if (range == 0)
      continue;
    const Eigen::Vector3d p =
        0.01 * perceptronPoint(static_cast<int>(i) / PERCEPTRON_SIZE,
                               static_cast<int>(i) % PERCEPTRON_SIZE, range);
    const float point[3] = {static_cast<float>(-p.x()), static_cast<float>(-p.y()),
                            static_cast<float>(p.z())};
    std::memcpy(&frame.file.cloud.data[i * frame.file.cloud.point_step], point,
                sizeof point);
  }
  frame.truth = truthBeside(path, {PERCEPTRON_SIZE, PERCEPTRON_SIZE});
  return frame;
}

} // namespace pcl_mrf_planes::io
