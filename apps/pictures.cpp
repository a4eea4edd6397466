// SPDX-License-Identifier: BSD-3-Clause
#include "pictures.h"

#include "label_colours.h"
#include "output_file.h"

#include <pcl/io/png_io.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <fstream>
#include <stdexcept>

namespace pcl_mrf_planes::apps {

namespace {

constexpr Colour BLACK = {0, 0, 0};
constexpr Colour WHITE = {255, 255, 255};
constexpr double LABEL_SHARE = 0.6; // of a label's colour over the picture
constexpr int SHADING_REACH = 4;    // points to either side: evens out noise

Colour mix(const Colour& below, const Colour& above, double share)
{
  Colour result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(
        std::lround((1.0 - share) * below[c] + share * above[c]));
  return result;
}

Colour gray(double brightness)
{
  const auto value = static_cast<std::uint8_t>(
      std::lround(255.0 * std::max(0.0, std::min(1.0, brightness))));
  return {value, value, value};
}

std::size_t indexOf(const OrganizedPoints& points, int x, int y)
{
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(points.width) +
         static_cast<std::size_t>(x);
}

Eigen::Vector3d pointAt(const OrganizedPoints& points, std::size_t i)
{
  return Eigen::Vector3d(points.x[i], points.y[i], points.z[i]);
}

/// Difference of the valid points around (x, y) in a direction; zero without two.
Eigen::Vector3d step(const OrganizedPoints& points, int x, int y, int dx, int dy)
{
  const auto valid = [&](int px, int py) {
    return px >= 0 && px < points.width && py >= 0 && py < points.height &&
           points.valid[indexOf(points, px, py)] != 0;
  };
  for (int reach = SHADING_REACH; reach > 0; --reach) {
    const int ax = x + reach * dx, ay = y + reach * dy;
    const int bx = x - reach * dx, by = y - reach * dy;
    const bool after = valid(ax, ay);
    const bool before = valid(bx, by);
    if (after || before)
      return pointAt(points, after ? indexOf(points, ax, ay) : indexOf(points, x, y)) -
             pointAt(points, before ? indexOf(points, bx, by) : indexOf(points, x, y));
  }
  return Eigen::Vector3d::Zero();
}

/// Gray by the angle between surface and view, as a lamp at the sensor would show it.
std::vector<Colour> shading(const OrganizedPoints& points)
{
  std::vector<Colour> result(points.size(), BLACK);
  for (int y = 0; y < points.height; ++y)
    for (int x = 0; x < points.width; ++x) {
      const std::size_t i = indexOf(points, x, y);
      if (points.valid[i] == 0)
        continue;
      const Eigen::Vector3d normal =
          step(points, x, y, 1, 0).cross(step(points, x, y, 0, 1));
      const double scale = normal.norm() * pointAt(points, i).norm();
      const double cosine =
          scale > 0.0 ? std::abs(normal.dot(pointAt(points, i))) / scale : 0.0;
      result[i] = gray(0.2 + 0.75 * cosine);
    }
  return result;
}

/// Depth below which the given share of the valid points lies.
float depthQuantile(std::vector<float>& depths, double share)
{
  const auto rank =
      static_cast<std::ptrdiff_t>(share * static_cast<double>(depths.size() - 1));
  std::nth_element(depths.begin(), depths.begin() + rank, depths.end());
  return depths[static_cast<std::size_t>(rank)];
}

std::vector<Colour> depthColours(const OrganizedPoints& points)
{
  std::vector<float> depths;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0)
      depths.push_back(points.depth(i));
  std::vector<Colour> result(points.size(), BLACK);
  if (depths.empty())
    return result;
  // A few stray points must not use up the range of colours.
  const double near = depthQuantile(depths, 0.02);
  const double far = std::max<double>(depthQuantile(depths, 0.98), near + 1e-6);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points.valid[i] != 0) {
      const double share = (points.depth(i) - near) / (far - near);
      const double inside = std::max(0.0, std::min(1.0, share));
      result[i] = colourFromHue(250.0 * inside, 0.9, 0.55 - 0.15 * inside);
    }
  return result;
}

std::vector<Colour> blendLabels(const std::vector<Colour>& below,
                                const pcl::PointCloud<pcl::Label>& labels)
{
  std::vector<Colour> result = below;
  for (std::size_t i = 0; i < result.size(); ++i) {
    // Brightness only: the picture's own hues would pass for labels.
    const double brightness =
        (0.299 * below[i][0] + 0.587 * below[i][1] + 0.114 * below[i][2]) / 255.0;
    const Colour plain = gray(brightness);
    const std::uint32_t label = labels[i].label;
    result[i] = label == 0 ? gray(0.5 * brightness)
                           : mix(plain, labelColour(label), LABEL_SHARE);
  }
  return result;
}

void paste(Picture& picture, int left, int top, const std::vector<Colour>& panel,
           int width)
{
  for (std::size_t i = 0; i < panel.size(); ++i) {
    const auto w = static_cast<std::size_t>(width);
    const std::size_t x = static_cast<std::size_t>(left) + i % w;
    const std::size_t y = static_cast<std::size_t>(top) + i / w;
    picture.pixels[y * static_cast<std::size_t>(picture.width) + x] = panel[i];
  }
}

/// Writes a PNG by PCL, which does not say when it could not.
template <typename Write>
void writePng(const std::string& path, const Write& write)
{
  writeAtomically(path, [&](const std::string& temporary) {
    try {
      write(temporary);
    }
    catch (const std::exception&) { // the check below tells
    }
    std::ifstream stream(temporary, std::ios::binary);
    std::array<char, 8> end{};
    stream.seekg(-8, std::ios::end);
    if (!stream.read(end.data(), end.size()) ||
        std::string(end.data(), 4) != "IEND") // the last chunk: name and checksum
      throw std::runtime_error("cannot write '" + path +
                               "' as PNG; check the space on the disk");
  });
}

} // namespace

Picture overlay(const OrganizedPoints& points, const std::vector<Colour>& colours,
                const pcl::PointCloud<pcl::Label>& labels)
{
  const std::vector<Colour> first = colours.empty() ? shading(points) : colours;
  const std::array<std::vector<Colour>, 3> panels = {first, depthColours(points),
                                                     blendLabels(first, labels)};
  const bool stacked = points.width > 2 * points.height;
  const int across = stacked ? 0 : points.width + PANEL_GAP;
  const int down = stacked ? points.height + PANEL_GAP : 0;
  Picture picture(points.width + 2 * across, points.height + 2 * down, WHITE);
  for (int k = 0; k < 3; ++k)
    paste(picture, k * across, k * down, panels[static_cast<std::size_t>(k)],
          points.width);
  return picture;
}

Picture sight(const OrganizedPoints& points, const std::vector<Colour>& colours)
{
  Picture picture(points.width, points.height, BLACK);
  picture.pixels = colours.empty() ? shading(points) : colours;
  return picture;
}

Picture labelPanel(const OrganizedPoints& points, const std::vector<Colour>& colours,
                   const pcl::PointCloud<pcl::Label>& labels)
{
  Picture picture = sight(points, colours);
  picture.pixels = blendLabels(picture.pixels, labels);
  return picture;
}

Picture stack(const Picture& above, const Picture& below)
{
  Picture both(std::max(above.width, below.width),
               above.height + PANEL_GAP + below.height, WHITE);
  paste(both, 0, 0, above.pixels, above.width);
  paste(both, 0, above.height + PANEL_GAP, below.pixels, below.width);
  return both;
}

OrganizedPoints inSensorFrame(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                              DepthMeasure measure)
{
  OrganizedPoints points;
  points.resize(static_cast<int>(cloud.width), static_cast<int>(cloud.height));
  Eigen::Quaternionf turn = cloud.sensor_orientation_;
  if (!(turn.norm() > 0.5f && turn.norm() < 2.0f)) // an unset one is no rotation
    turn.setIdentity();
  const Eigen::Matrix3f to_sensor = turn.normalized().toRotationMatrix().transpose();
  Eigen::Vector3f origin = cloud.sensor_origin_.head<3>();
  if (!origin.allFinite())
    origin.setZero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f p = to_sensor * (cloud[i].getVector3fMap() - origin);
    points.set(i, p.x(), p.y(), p.z());
  }
  points.resolveDepthMeasure(measure);
  return points;
}

void writePicture(const std::string& path, const Picture& picture)
{
  std::vector<unsigned char> bytes;
  bytes.reserve(3 * picture.pixels.size());
  for (const Colour& pixel : picture.pixels)
    bytes.insert(bytes.end(), pixel.begin(), pixel.end());
  writePng(path, [&](const std::string& temporary) {
    pcl::io::saveRgbPNGFile(temporary, bytes.data(), picture.width, picture.height);
  });
}

void writeMask(const std::string& path, const std::vector<unsigned char>& mask,
               int width, int height)
{
  writePng(path, [&](const std::string& temporary) {
    pcl::io::saveCharPNGFile(temporary, mask.data(), width, height, 1);
  });
}

void writeLabelImage(const std::string& path, const pcl::PointCloud<pcl::Label>& labels)
{
  std::vector<unsigned short> values;
  values.reserve(labels.size());
  for (const auto& point : labels)
    values.push_back(static_cast<unsigned short>(point.label));
  writePng(path, [&](const std::string& temporary) {
    pcl::io::saveShortPNGFile(temporary, values.data(), static_cast<int>(labels.width),
                              static_cast<int>(labels.height), 1);
  });
}

} // namespace pcl_mrf_planes::apps
